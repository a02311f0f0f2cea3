"""The octomap of a planning scene as a topic of its own, octomap_msgs/Octomap, which `clouds:` of a scene file can name."""

import rospy

from rigid_transforms import IDENTITY, are_near, normalized

TYPE = "octomap_msgs/Octomap"


class OctomapRelay:
    def __init__(self):
        self.topic = rospy.resolve_name("~octomap")
        self.refused = ""  # why the octomap at hand is not published
        self.text = ""     # what was published last; empty: no octomap
        self._publisher = self._class = None

    def use(self, with_pose, octomap_class):
        """Publishes the octomap of an OctomapWithPose; an empty one where there was one and is none any more."""
        octomap, origin = with_pose.octomap, with_pose.origin
        pose = normalized(((origin.position.x, origin.position.y, origin.position.z),
                           (origin.orientation.x, origin.orientation.y, origin.orientation.z, origin.orientation.w)))
        self.refused = ""
        if octomap.data and not are_near(pose, IDENTITY):
            self.refused = "its origin is not that of its frame '%s', which no message of an octomap alone can say" % (
                with_pose.header.frame_id)
            octomap.data = []
        if not octomap.data and not self.text:
            return
        if self._class is not octomap_class:
            if self._publisher:
                self._publisher.unregister()
            self._class = octomap_class
            self._publisher = rospy.Publisher(self.topic, octomap_class, queue_size=1, latch=True)
        self.text = "%s of %d bytes in '%s'" % (octomap.id, len(octomap.data), with_pose.header.frame_id) if (
            octomap.data) else ""
        octomap.header.frame_id = with_pose.header.frame_id
        octomap.header.stamp = rospy.Time.now()
        octomap.id = octomap.id or "OcTree"
        octomap.resolution = octomap.resolution or 0.1  # An empty one needs a length, too.
        self._publisher.publish(octomap)

    def problem(self):
        """Why distances do not know of the octomap, or an empty text."""
        if self.refused:
            return "not served: " + self.refused
        if self.text and self._publisher.get_num_connections() == 0:
            return "%s is not served: nobody subscribes to '%s' (name this topic under clouds: of the scene file)" % (
                self.text, self.topic)
        return ""
