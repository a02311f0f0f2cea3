"""Requests of the attacks, and checks of the answers."""

from attacks import expect, shortened

LONGEST_MESSAGE = 20000  # characters; a message must not repeat a megabyte of the request
MEGABYTE = "m" * 2**20


def query(arena, body_a="box_a", body_b="box_b", posed=True, **fields):
    """A valid query, changed by the fields; both poses are given unless posed is False."""
    question = arena.messages.DistanceQuery(body_a=body_a, body_b=body_b, use_pose_a=posed, use_pose_b=posed)
    question.pose_a.pose.orientation.w = 1.0
    question.pose_b.pose.orientation.w = 1.0
    question.pose_b.pose.position.x = 2.0
    for name, value in fields.items():
        set_field(question, name, value)
    return question


def set_field(message, name, value):
    """Sets a field by its path, as pose__position__x."""
    *path, last = name.split("__")
    for step in path:
        message = getattr(message, step)
    setattr(message, last, value)


def ask(arena, timeout=20.0, replace=(), **fields):
    request = arena.services.GetDistanceRequest(query=query(arena, **fields))
    return arena.node.call("get_distance", arena.services.GetDistance, request, timeout, replace)


def call(arena, service, timeout=20.0, replace=(), **fields):
    """Calls one of the node's services by its name, with fields by their paths."""
    service_class = getattr(arena.services, "".join(part.capitalize() for part in service.split("_")))
    request = service_class._request_class()
    for name, value in fields.items():
        set_field(request, name, value)
    return arena.node.call(service, service_class, request, timeout, replace)


def require_refused(response, *words):
    """The response is a refusal with a message of sensible length that contains one of the words, if any."""
    expect(not response.success, "it was accepted")
    expect(response.message, "it was refused without a message")
    expect(len(response.message) <= LONGEST_MESSAGE, "the message has %d characters" % len(response.message))
    expect(not words or any(word.lower() in response.message.lower() for word in words),
           "the message names none of %s: %s" % (", ".join(words), shortened(response.message)))


def require_sound(response):
    """The response is a refusal with a reason, or a success."""
    if not response.success:
        require_refused(response)
