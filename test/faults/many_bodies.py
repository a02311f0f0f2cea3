#!/usr/bin/env python3
"""Adds thousands of boxes to a running node, one by one, and prints the time of the calls and the node's memory.

Usage: many_bodies.py [--count 10000] [--node /concave_distance] [--pairs one|none|niches] [--most-ms 10] [--most-mb 1000]

It needs a master and a node with an empty scene (robot_description: ""). All boxes have different sizes and poses, so
that no two share a mesh. --pairs one: each is watched against the first one; none: against nothing; niches: as one, with
a subscriber to niches while boxes are added. Ends with status 1 when the median call or the memory is beyond its limit.
"""
import argparse
import sys
import time
import xmlrpc.client

import rospy
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

from concave_distance.msg import Niches
from concave_distance.srv import AddBody, AddBodyRequest, ListBodies, RemoveBody


def memory_of(node):
    """Resident megabytes of the node's process, and their peak."""
    address = rospy.get_master().lookupNode(node)[2]
    pid = xmlrpc.client.ServerProxy(address).getPid(rospy.get_name())[2]
    fields = {}
    with open("/proc/%d/status" % pid, encoding="utf-8") as status:
        for line in status:
            name, _, value = line.partition(":")
            fields[name] = value.split()
    return int(fields["VmRSS"][0]) / 1024.0, int(fields["VmHWM"][0]) / 1024.0


def share(times, fraction):
    ordered = sorted(times)
    return ordered[min(len(ordered) - 1, int(fraction * len(ordered)))]


def box(index, arguments):
    request = AddBodyRequest()
    request.name = "box%d" % index
    request.frame_id = "frame%d" % index
    request.pose.orientation.w = 1.0
    request.pose.position.x = 1e-3 * index
    request.primitive = "box"
    request.dimensions = [0.1, 0.2, 0.3 + 1e-6 * index]
    if arguments.pairs == "none" or index == 0:
        request.without_pairs = True
    else:
        request.pair_with = ["box0"]
    return request


def place_frames(count):
    """Static transforms of all frames: the boxes stand side by side, a metre above the first one."""
    publisher = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
    message = TFMessage()
    for index in range(count):
        transform = TransformStamped()
        transform.header.frame_id = "world"
        transform.child_frame_id = "frame%d" % index
        transform.transform.rotation.w = 1.0
        transform.transform.translation.z = 1.0 if index > 0 else 0.0
        message.transforms.append(transform)
    publisher.publish(message)
    return publisher


def timed(calls):
    times = []
    for call in calls:
        start = time.perf_counter()
        answer = call()
        times.append(1e3 * (time.perf_counter() - start))
        if not answer.success:
            sys.exit("refused: " + answer.message)
    return times


def last_pairs(node):
    """How many pairs were solved with niches in the next cycle."""
    message = rospy.wait_for_message(node + "/niches", Niches, timeout=300.0)
    return "%d of %d pairs" % (sum(bool(pair.niches) for pair in message.pairs), len(message.pairs))


def report(name, times):
    print("%-12s median %.2f ms, 99 %% below %.2f ms, longest %.1f ms, of %d calls"
          % (name, share(times, 0.5), share(times, 0.99), max(times), len(times)), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=10000)
    parser.add_argument("--node", default="/concave_distance")
    parser.add_argument("--pairs", choices=["one", "none", "niches"], default="one")
    parser.add_argument("--most-ms", type=float, default=10.0)
    parser.add_argument("--most-mb", type=float, default=1000.0)
    arguments = parser.parse_args(rospy.myargv()[1:])
    rospy.init_node("many_bodies")
    for service in ("add_body", "remove_body", "list_bodies"):
        rospy.wait_for_service(arguments.node + "/" + service, timeout=60.0)
    add = rospy.ServiceProxy(arguments.node + "/add_body", AddBody, persistent=True)
    remove = rospy.ServiceProxy(arguments.node + "/remove_body", RemoveBody, persistent=True)
    listing = rospy.ServiceProxy(arguments.node + "/list_bodies", ListBodies)
    if arguments.pairs == "niches":
        publisher = place_frames(arguments.count)
        subscriber = rospy.Subscriber(arguments.node + "/niches", Niches, lambda _: None)
    print("before: %.0f MB" % memory_of(arguments.node)[0], flush=True)
    adding = []
    for first in range(0, arguments.count, 1000):
        last = min(first + 1000, arguments.count)
        adding += timed(lambda i=i: add(box(i, arguments)) for i in range(first, last))
        print("%6d boxes: %.0f MB, the last %d calls: median %.2f ms"
              % (last, memory_of(arguments.node)[0], last - first, share(adding[first:], 0.5)), flush=True)
    report("add_body", adding)
    start = time.perf_counter()
    scene = listing()
    print("list_bodies  %.1f ms for %d bodies and %d pairs"
          % (1e3 * (time.perf_counter() - start), len(scene.bodies), len(scene.pairs)), flush=True)
    rss, most = memory_of(arguments.node)
    if arguments.pairs == "niches":
        print("niches of the last cycle: %s" % last_pairs(arguments.node), flush=True)
        rss, most = memory_of(arguments.node)
        subscriber.unregister()
        publisher.unregister()
    removing = timed(lambda i=i: remove(name="box%d" % i) for i in range(arguments.count - 1, arguments.count // 2, -37))
    report("remove_body", removing)
    print("memory: %.0f MB, at most %.0f MB" % (rss, most), flush=True)
    good = (share(adding, 0.5) <= arguments.most_ms and rss <= arguments.most_mb
            and len(scene.bodies) == arguments.count)
    print("good" if good else "TOO MUCH", flush=True)
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
