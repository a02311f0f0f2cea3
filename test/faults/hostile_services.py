"""The other services, and settings that change while the node runs."""

import threading
import time

import dynamic_reconfigure.msg
import dynamic_reconfigure.srv
from attacks import Failed, Group, expect
from request_checks import MEGABYTE, call, require_refused

group = Group("services", {})
NAN, INF = float("nan"), float("inf")


def refuse(label, service, words, fast=False, **fields):
    group.add(label, lambda arena: require_refused(call(arena, service, **fields), *words), fast=fast)


NAMES = {"empty": "", "unknown": "nobody", "of_a_megabyte": MEGABYTE, "with_nul": "box_a\0", "pattern": "*"}
for key, text in NAMES.items():
    refuse("remove_body_" + key, "remove_body", ("body", "name"), name=text)
    if key not in ("empty", "pattern"):
        refuse("reset_tracking_" + key, "reset_tracking", ("pair",), pair=text)
        refuse("set_pair_enabled_" + key, "set_pair_enabled", ("pair",), pair=text, enabled=True)
refuse("set_pair_enabled_without_a_name", "set_pair_enabled", ("body", "pair"), fast=True)
refuse("set_pair_enabled_of_one_body", "set_pair_enabled", ("body",), body_a="box_a", enabled=True)
refuse("set_pair_enabled_of_a_body_with_itself", "set_pair_enabled", ("bod",), body_a="box_a", body_b="box_a")
refuse("set_pair_disabled_that_is_none", "set_pair_enabled", ("pair",), body_a="box_a", body_b="blocks")


@group.attack(fast=True)
def reset_of_every_pair(arena):
    response = call(arena, "reset_tracking")
    expect(response.success and response.count == 4, "%d pairs: %s" % (response.count, response.message))
    arena.require_tracking()


# Effects

BOMB = "a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
    "%s: &%s [%s]\n" % (name, name, ", ".join(["*" + before] * 9)) for before, name in zip("abcdefgh", "bcdefghi"))
EFFECTS = {
    "unknown_key": "{gravity: 9.81}", "unknown_model": "{normal_force: magic}", "text": "all of them",
    "list": "[interference]", "number": "17", "nan": "{normal_force: {model: spring_dashpot, stiffness: .nan}}",
    "negative": "{normal_force: {model: spring_dashpot, stiffness: -1}}", "not_closed": "{normal_force: hertz",
    "tag": "!!python/object/apply:os.system ['id']", "binary": "\x01\x02\x03", "nul": "{normal_force\0: hertz}",
    "bomb": BOMB, "recursive": "&a [*a]", "recursive_map": "&a {normal_force: *a}", "alias_unknown": "*b",
    "document_twice": "none\n---\nnone", "tabs": "\t\tnormal_force: hertz", "key_twice":
    "{normal_force: hertz, normal_force: none}", "friction_alone": "{friction: bristle}", "of_a_megabyte": MEGABYTE,
    "merge": "{<<: {gravity: 1}}", "map_as_key": "{{a: b}: c}",
}
for key, text in EFFECTS.items():
    refuse("effects_" + key, "set_effects", (), pair="boxes", effects=text)
DEEP = {"lists": "[" * 100000, "maps": "{a: " * 50000, "closed_lists": "[" * 20000 + "]" * 20000,
        "blocks": "".join(" " * depth + "a:\n" for depth in range(1400)), "dashes": "- " * 50000}
for key, text in DEEP.items():
    refuse("effects_deep_" + key, "set_effects", (), pair="boxes", effects=text)
PATTERNS = {"stars": "*" * 1000 + "q", "alternating": "*b" * 500 + "q", "questions": "?" * 100000, "brackets": "[" * 1000,
            "of_a_megabyte": "*o" * 2**19 + "q"}
for key, text in PATTERNS.items():
    refuse("effects_of_pairs_" + key, "set_effects", (), pair=text, effects="none")


# Settings that change while the node runs

def reconfigure(arena, timeout=20.0, **values):
    request = dynamic_reconfigure.srv.ReconfigureRequest()
    for name, value in values.items():
        if isinstance(value, bool):
            request.config.bools.append(dynamic_reconfigure.msg.BoolParameter(name, value))
        elif isinstance(value, int):
            request.config.ints.append(dynamic_reconfigure.msg.IntParameter(name, value))
        elif isinstance(value, str):
            request.config.strs.append(dynamic_reconfigure.msg.StrParameter(name, value))
        else:
            request.config.doubles.append(dynamic_reconfigure.msg.DoubleParameter(name, value))
    return arena.node.call("set_parameters", dynamic_reconfigure.srv.Reconfigure, request, timeout)


def values_of(response):
    return {parameter.name: parameter.value for kind in (response.config.doubles, response.config.ints)
            for parameter in kind}


def texts_of(response):
    return {parameter.name: parameter.value for parameter in response.config.strs}


def reported(arena, name, value, accepted_range):
    """A value outside the range is refused or limited, and the log names the parameter."""
    mark = arena.node.log_length()
    before = values_of(reconfigure(arena))
    try:
        after = values_of(reconfigure(arena, **{name: value}))
        least, most = accepted_range
        expect(least <= after[name] <= most, "%s is %r now" % (name, after[name]))
        arena.wait_until(lambda: name in arena.node.log(mark), 5.0, "the log does not name " + name)
        arena.require_tracking()
    finally:
        reconfigure(arena, **{name: before[name]})


OUTSIDE = {"rate": (0.0, -5.0, 1e9, NAN), "marker_rate": (NAN, 1e9),
           "absolute_tolerance": (-1.0, NAN), "relative_tolerance": (2.0, NAN),
           "least_prominence": (-1.0, INF), "largest_niche_count": (0, -2**31)}
RANGES = {"rate": (0.1, 2000.0), "marker_rate": (0.1, 200.0), "absolute_tolerance": (0.0, 1e6), "relative_tolerance": (0.0, 1.0), "least_prominence": (0.0, 1000.0),
          "largest_niche_count": (1, 2**31 - 1)}
for parameter, outside in OUTSIDE.items():
    for number in outside:
        group.add("reconfigure_%s_%g" % (parameter, number), lambda arena, parameter=parameter, number=number:
                  reported(arena, parameter, number, RANGES[parameter]), storms=False)


def refused_text(arena, name, text):
    """A text that is no value of the parameter changes nothing, and the log names the parameter."""
    mark = arena.node.log_length()
    before = texts_of(reconfigure(arena))
    after = texts_of(reconfigure(arena, **{name: text}))
    expect(after == before, "%s is %r now" % (name, after[name]))
    arena.wait_until(lambda: name in arena.node.log(mark), 5.0, "the log does not name " + name)
    arena.require_tracking()


for parameter in ("cutoff", "time_budget"):
    for label, text in {"negative": "-1", "zero": "0", "nan": "nan", "inf": "inf", "word": "far", "empty": "",
                        "long": "9" * 100000}.items():
        group.add("reconfigure_%s_%s" % (parameter, label), lambda arena, parameter=parameter, text=text:
                  refused_text(arena, parameter, text), storms=False)


@group.attack()
def reconfigure_hundred_thousand_unknown_values(arena):
    request = dynamic_reconfigure.srv.ReconfigureRequest()
    request.config.doubles = [dynamic_reconfigure.msg.DoubleParameter("p%d" % index, 1.0) for index in range(100000)]
    arena.node.call("set_parameters", dynamic_reconfigure.srv.Reconfigure, request, 20.0)
    arena.require_tracking()


@group.attack(storms=False)
def reconfigure_hundred_times_a_second(arena):
    for index in range(300):
        reconfigure(arena, rate=50.0 + index % 7, marker_rate=20.0)
    reconfigure(arena, rate=50.0)
    arena.require_tracking()


# The end

def end_in_time(arena, busy):
    threads = [threading.Thread(target=busy, daemon=True) for _ in range(6)]
    for thread in threads:
        thread.start()
    time.sleep(1.0)
    seconds = arena.node.stop()
    expect(seconds is not None, "it had to be killed 15 s after SIGINT")
    expect(seconds <= 10.0 * arena.patience, "it took %.1f s to end after SIGINT" % seconds)


@group.attack(dies=True, storms=False, deadline=60.0)
def sigint_while_every_niche_is_asked_for(arena):
    from request_checks import ask

    def busy():
        for _ in range(20):
            try:
                ask(arena, body_a="hook", body_b="comb", accuracy=4, with_niches=True, pose_b__pose__position__x=100.0)
            except Failed:
                return
    end_in_time(arena, busy)


@group.attack(dies=True, storms=False, deadline=60.0)
def sigint_while_bodies_are_added(arena):
    def busy():
        for index in range(10000):
            try:
                call(arena, "add_body", name="late_%d_%d" % (threading.get_ident(), index), frame_id="world",
                     primitive="sphere", dimensions=[0.1], pose__orientation__w=1.0)
            except Failed:
                return
    end_in_time(arena, busy)


@group.attack(dies=True, storms=False, deadline=60.0)
def sigint_at_rest(arena):
    end_in_time(arena, lambda: None)
