"""Parameters of the wrong type or value: the node ends at once and names the parameter, or says that it is ignored."""

import itertools
import time

from attacks import Group, expect, shortened

group = Group("parameters")
counter = itertools.count()
TEXT, LIST, MAP = "abc", [1, 2, 3], {"a": 1}
NAN, INF = float("nan"), float("inf")


def ends_with_its_name(arena, parameters, *words):
    """The node exits within seconds with a status that is not 0 and a message with all the words."""
    node = arena.start_node("parameter_%d" % next(counter), parameters)
    try:
        status = node.wait_for_end(15.0)
        expect(status is not None, "it runs on: " + shortened(node.log()[-300:]))
        expect(status > 0, "it ended with %d: %s" % (status, node.why_dead()))
        missing = [word for word in words if word not in node.log()]
        expect(not missing, "the message does not name %s: %s" % (", ".join(missing), shortened(node.log()[-300:])))
    finally:
        arena.stop_node()


def goes_on_with_a_warning(arena, parameters, *words):
    node = arena.start_node("parameter_%d" % next(counter), parameters)
    try:
        node.wait_until_ready(30.0)
        missing = [word for word in words if word not in node.log()]
        expect(not missing, "the log does not name " + ", ".join(missing))
    finally:
        arena.stop_node()


def refuse(parameter, label, value):
    group.add("%s_%s" % (parameter.replace("/", "_"), label),
              lambda arena: ends_with_its_name(arena, {parameter: value}, parameter.split("/")[-1]), deadline=60.0,
              fast=(parameter, label) in (("rate", "text"), ("accuracy", "number")))


NUMBERS = {"rate": (0.0, -1.0, NAN), "marker_rate": (0.0,), "transform_timeout": (-1.0, INF), "stale_after": (0.0,),
           "tf_cache": (-10.0, 1e300), "absolute_tolerance": (-1.0, NAN), "relative_tolerance": (1.5,),
           "time_budget": (-1.0, NAN), "cutoff": (-1.0, NAN), "least_prominence": (-1.0,), "warning_distance": (NAN, -1.0),
           "warning_hysteresis": (-1.0,), "marker_scale": (-1.0,), "force_marker_scale": (0.0,),
           "pressure_marker_scale": (-1.0,), "diagnostic_period": (-5.0, 0.0, NAN, 1e300)}
for parameter, numbers in NUMBERS.items():
    for number in numbers:
        refuse(parameter, "%g" % number, number)
    refuse(parameter, "text", TEXT)
    refuse(parameter, "list", LIST)
COUNTS = {"threads": -1, "largest_niche_count": 0, "expert/cold/population_size": 3, "expert/cold/max_generations": -1,
          "expert/warm/population_size": 1, "expert/warm/max_generations": -5, "expert/random_starts": -2,
          "seed": -2147483648}
for parameter, number in COUNTS.items():
    refuse(parameter, "%d" % number, number)
    refuse(parameter, "map", MAP)
    refuse(parameter, "fraction", 2.5)
TEXTS = ("scene_file", "robot_description", "reference_frame", "geometry", "cache", "accuracy")
for parameter in TEXTS:
    refuse(parameter, "number", 17)
    refuse(parameter, "list", ["a", "b"])
for parameter in ("hidden", "expert/keep_through_material", "publish_markers", "publish_contact_markers", "show_bodies"):
    refuse(parameter, "text", "yes please")
    refuse(parameter, "number", 17)
refuse("accuracy", "unknown", "perfect")
refuse("geometry", "unknown", "both")
for label, frame in {"empty": "", "slash": "/", "with_blank": "a b", "slashes": "///", "newline": "a\nb"}.items():
    refuse("reference_frame", label, frame)
refuse("limits/largest_body_count", "text", TEXT)
refuse("limits/query_seconds", "negative", -1.0)
refuse("limits", "text", TEXT)


@group.attack(deadline=60.0)
def unknown_parameter(arena):
    goes_on_with_a_warning(arena, {"acuracy": "certified"}, "acuracy")


@group.attack(deadline=60.0)
def thousand_unknown_parameters(arena):
    goes_on_with_a_warning(arena, {"unknown_%d" % index: index for index in range(1000)}, "unknown_7")


@group.attack(deadline=60.0)
def unknown_map_nested_100_deep(arena):
    value = 1
    for _ in range(100):
        value = {"deeper": value}
    goes_on_with_a_warning(arena, {"strange": value}, "strange")


@group.attack(deadline=60.0)
def text_of_ten_megabytes(arena):
    ends_with_its_name(arena, {"accuracy": "x" * 10**7}, "accuracy")


@group.attack(deadline=60.0)
def whole_namespace_is_a_number(arena):
    """The node's own name is set as a parameter."""
    arena.stop_node()
    arena.delete_parameter("/concave_distance")
    from node_under_test import NODE, Node
    node = None
    original = arena.set_parameters
    arena.set_parameters = lambda namespace, values: arena.set_parameter(namespace, 17)
    try:
        node = arena.running_node = Node(arena, {}, "parameter_namespace")
        time.sleep(2.0)
        expect(node.alive() or node.process.poll() > 0, "it ended: " + node.why_dead())
    finally:
        arena.set_parameters = original
        arena.stop_node()
        arena.delete_parameter(NODE)


@group.attack(deadline=60.0)
def diagnostic_period_does_not_burn_a_core(arena):
    """At rest, with diagnostics once a second, the node is mostly idle."""
    node = arena.start_node("parameter_period", {"diagnostic_period": 1.0})
    try:
        node.wait_until_ready()
        before = node.processor_seconds()
        time.sleep(2.0)
        busy = node.processor_seconds() - before
        expect(busy < 0.7, "%.1f s of processor time in 2 s at rest" % busy)
    finally:
        arena.stop_node()


@group.attack(deadline=60.0)
def least_prominence_of_five_stays_in_memory(arena):
    """With a large least prominence a cycle and a query stay below a gigabyte."""
    node = arena.start_node("parameter_prominence", {"least_prominence": 5.0})
    from request_checks import ask
    try:
        node.wait_until_ready()
        arena.listen()
        for level in (3, 4):
            ask(arena, body_a="hook", body_b="comb", accuracy=level, with_niches=True, timeout=20.0,
                pose_b__pose__position__x=0.3)
        arena.require_tracking()
        expect(node.memory.peak_mb < 1000.0 * arena.memory_factor, "%.0f MB" % node.memory.peak_mb)
    finally:
        arena.stop_node()
