"""What bridges share: what is wrong at present, by name, logged once when it comes and when it goes and shown in
/diagnostics; and parameters."""

import re
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue


_LEAST_PAUSE = 5.0  # s, between two texts of one problem in the log


class Problems:
    def __init__(self):
        self.texts = {}
        self._logged = {}  # monotonic time, by name

    def set(self, name, text, is_expected=False):
        """is_expected: a part that has not started yet, such as MoveIt itself."""
        is_new, is_other = name not in self.texts, self.texts.get(name) != text
        self.texts[name] = text
        if is_new or is_other and time.monotonic() - self._logged.get(name, 0.0) > _LEAST_PAUSE:
            self._logged[name] = time.monotonic()
            (rospy.loginfo if is_expected else rospy.logwarn)("%s: %s", name, text)

    def clear(self, name):
        if self.texts.pop(name, None) is not None:
            rospy.loginfo("%s: no longer", name)

    def keep(self, names, of):
        """Clears those that `of` accepts and `names` does not have."""
        for name in [one for one in list(self.texts) if of(one) and one not in names]:
            self.clear(name)


class DiagnosticsPublisher:
    def __init__(self):
        self._publisher = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=1)

    def publish(self, message, problems, values):
        """One entry: WARN while there are problems, each with its name as key; then values."""
        name = rospy.get_name().lstrip("/")
        status = DiagnosticStatus(name=name, hardware_id=name, message=message)
        status.level = DiagnosticStatus.WARN if problems else DiagnosticStatus.OK
        status.values = [KeyValue(key, text) for key, text in sorted(problems.items())]
        status.values += [KeyValue(key, str(value)) for key, value in values]
        array = DiagnosticArray(status=[status])
        array.header.stamp = rospy.Time.now()
        self._publisher.publish(array)


def positive_parameter(name, default, or_zero=False):
    value = rospy.get_param(name, default)
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not is_number or not (0.0 < value < float("inf") or or_zero and value == 0.0):
        raise ValueError("%s is %r (allowed: %s)" % (name, value, "0 or more" if or_zero else "greater than 0"))
    return float(value)


def prefix_parameter(name, default):
    """What names of the bridge's bodies begin with."""
    prefix = rospy.get_param(name, default)
    if not isinstance(prefix, str) or not re.match(r"[A-Za-z][A-Za-z0-9_]*(/[A-Za-z0-9_]+)*/?\Z", prefix):
        raise ValueError("%s is %r: begin with a letter, then letters, digits, _ and /; bodies whose names begin with it "
                         "belong to this node" % (name, prefix))
    return prefix
