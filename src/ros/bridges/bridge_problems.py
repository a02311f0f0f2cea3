"""What bridges share: what is wrong at present, by name, logged once when it comes and when it goes and shown in
/diagnostics; and parameters."""

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue


class Problems:
    def __init__(self):
        self.texts = {}

    def set(self, name, text, is_expected=False):
        """is_expected: a part that has not started yet, such as MoveIt itself."""
        if self.texts.get(name) != text:
            self.texts[name] = text
            (rospy.loginfo if is_expected else rospy.logwarn)("%s: %s", name, text)

    def clear(self, name):
        if self.texts.pop(name, None) is not None:
            rospy.loginfo("%s: no longer", name)

    def keep(self, names, of):
        """Clears those that `of` accepts and `names` does not have."""
        for name in [one for one in self.texts if of(one) and one not in names]:
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
