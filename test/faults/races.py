"""Simultaneous requests of many clients."""

import random
import threading
import time

from attacks import Failed, Group, expect
from request_checks import ask, call, require_sound

group = Group("races", {})
SECONDS = 4.0


def at_once(arena, *works):
    """Runs each work in a thread again and again for some seconds; the first Failed is raised."""
    problems = []
    ends = time.monotonic() + SECONDS

    def repeat(index, work):
        engine = random.Random(index)
        while time.monotonic() < ends and not problems:
            try:
                work(engine)
            except Failed as problem:
                problems.append(problem)
    threads = [threading.Thread(target=repeat, args=(index, work), daemon=True) for index, work in enumerate(works)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60.0 * arena.patience)
    expect(not any(thread.is_alive() for thread in threads), "a client still waits a minute later")
    if problems:
        raise problems[0]


def clear(arena, prefix):
    for body in arena.node.list_bodies().bodies:
        if body.name.startswith(prefix):
            call(arena, "remove_body", name=body.name)


def added(arena, name, **fields):
    return call(arena, "add_body", name=name, frame_id="world", primitive="box", dimensions=[0.1, 0.1, 0.1],
                pose__orientation__w=1.0, **fields)


@group.attack(deadline=90.0, fast=True)
def eight_threads_add_and_remove_the_same_name(arena):
    def work(engine):
        if engine.random() < 0.5:
            require_sound(added(arena, "disputed"))
        else:
            require_sound(call(arena, "remove_body", name="disputed"))
    at_once(arena, *[work] * 8)
    clear(arena, "disputed")


@group.attack(deadline=90.0)
def two_hundred_threads_add_one_name(arena):
    """Exactly one call succeeds."""
    won = []
    threads = [threading.Thread(target=lambda: won.append(bool(added(arena, "contested").success)), daemon=True)
               for _ in range(200)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60.0)
    clear(arena, "contested")
    expect(won.count(True) == 1, "%d of %d calls say that they added the body" % (won.count(True), len(won)))


@group.attack(deadline=90.0)
def questions_about_bodies_that_vanish(arena):
    def vanish(engine):
        name = "fleeting_%d" % engine.randrange(5)
        require_sound(added(arena, name) if engine.random() < 0.5 else call(arena, "remove_body", name=name))

    def asked(engine):
        require_sound(ask(arena, body_a="fleeting_%d" % engine.randrange(5), accuracy=4, with_niches=True))
    at_once(arena, vanish, vanish, vanish, asked, asked, asked)
    clear(arena, "fleeting")


@group.attack(deadline=90.0)
def pairs_switched_while_they_are_solved(arena):
    pairs = ["boxes", "box_ball", "hook_comb", "ball_blocks"]

    def switch(engine):
        require_sound(call(arena, "set_pair_enabled", pair=engine.choice(pairs), enabled=engine.random() < 0.5))

    def reset(engine):
        require_sound(call(arena, "reset_tracking", pair=engine.choice(pairs + [""])))
    at_once(arena, switch, switch, switch, reset, reset)
    for pair in pairs:
        call(arena, "set_pair_enabled", pair=pair, enabled=True)
    arena.require_tracking()


@group.attack(deadline=90.0)
def effects_switched_while_bodies_come_and_go(arena):
    effects = ["none", "{interference: true}", "{normal_force: hertz}", "{normal_force: hertz, friction: bristle}"]

    def effect(engine):
        require_sound(call(arena, "set_effects", pair=engine.choice(["*", "boxes", "guest*"]),
                           effects=engine.choice(effects)))

    def come(engine):
        name = "guest_%d" % engine.randrange(3)
        require_sound(added(arena, name) if engine.random() < 0.5 else call(arena, "remove_body", name=name))
    at_once(arena, effect, effect, come, come)
    clear(arena, "guest")
    call(arena, "set_effects", pair="*", effects="none")
    arena.require_tracking()


@group.attack(deadline=120.0, silence=10.0)
def sixty_clients_ask_for_every_niche(arena):
    """Each is answered, or refused because too many wait."""
    def work(_):
        require_sound(ask(arena, body_a="hook", body_b="comb", accuracy=4, with_niches=True, timeout=60.0,
                          pose_b__pose__position__x=0.5))
    at_once(arena, *[work] * 60)


@group.attack(deadline=120.0, growth_mb=400.0, silence=10.0)
def heavy_questions_leave_the_others_alone(arena):
    """While eight clients send the most expensive queries, another is served and the motion is followed."""
    stop = threading.Event()

    def heavy():
        while not stop.is_set():
            try:
                ask(arena, body_a="hook", body_b="comb", accuracy=4, with_niches=True, timeout=60.0,
                    pose_b__pose__position__x=100.0)
            except Failed:
                return
    threads = [threading.Thread(target=heavy, daemon=True) for _ in range(8)]
    for thread in threads:
        thread.start()
    try:
        time.sleep(1.0)
        for _ in range(5):
            arena.node.list_bodies(timeout=10.0)
        arena.require_tracking(20.0)
    finally:
        stop.set()


@group.attack(deadline=90.0, storms=False)
def clients_that_hang_up_before_the_answer(arena):
    import socket
    import struct
    import ros_wire
    from request_checks import query
    uri = arena.node.service_uri("get_distance")
    body = ros_wire.serialized(arena.services.GetDistanceRequest(
        query=query(arena, body_a="hook", body_b="comb", accuracy=4, with_niches=True)))
    header = ros_wire.connection_header(callerid="/faults", service=arena.node.name + "/get_distance",
                                        md5sum=arena.services.GetDistance._md5sum)
    for _ in range(100):
        with socket.create_connection(ros_wire.address_of(uri), timeout=10.0) as connection:
            connection.sendall(header + struct.pack("<I", len(body)) + body)
    require_sound(ask(arena, timeout=60.0))
    arena.require_tracking()
