"""Connections that break the protocols of ROS."""

import http.client
import socket
import struct
import threading
import time

import ros_wire
import rospy
from attacks import Failed, Group, expect
from request_checks import ask, call, query, require_sound

group = Group("wire", {})
SERVICE = "get_distance"


def header(arena, **changes):
    fields = {"callerid": "/faults", "service": arena.node.name + "/" + SERVICE,
              "md5sum": arena.services.GetDistance._md5sum}
    fields.update(changes)
    return ros_wire.connection_header(**{key: value for key, value in fields.items() if value is not None})


def connect(arena, uri=None):
    return socket.create_connection(ros_wire.address_of(uri or arena.node.service_uri(SERVICE)), timeout=10.0)


def send(arena, data, wait=0.5, uri=None):
    """Sends bytes, reads the answer for a moment, and disconnects."""
    with connect(arena, uri) as connection:
        try:
            connection.sendall(data)
            ends = time.monotonic() + wait
            while time.monotonic() < ends:
                connection.settimeout(max(0.01, ends - time.monotonic()))
                if not connection.recv(65536):
                    break
        except OSError:  # the node may disconnect at any time
            pass
    require_sound(ask(arena))


def sends(name, data_of, **options):
    group.add(name, lambda arena: send(arena, data_of(arena)), **options)


RAW = {
    "nothing": b"", "one_byte": b"\x01", "zeros": bytes(100000), "ones": b"\xff" * 100000,
    "http": b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n", "tls": bytes.fromhex("16030100a5010000a10303") + bytes(200),
    "header_of_4_gb": struct.pack("<I", 0xffffffff), "header_of_2_gb": struct.pack("<I", 0x7fffffff) + b"x" * 1000,
    "header_of_1_gb": struct.pack("<I", 1000000000) + b"x" * 1000, "header_of_no_length": struct.pack("<I", 0),
    "field_longer_than_the_header": struct.pack("<II", 100, 1000) + bytes(96),
    "field_of_4_gb": struct.pack("<II", 100, 0xffffffff) + bytes(96),
    "field_without_equals": struct.pack("<II", 12, 8) + b"callerid", "fields_of_no_length": struct.pack("<I", 400) + bytes(400),
}
for label, raw in RAW.items():
    sends("connection_with_" + label, lambda arena, raw=raw: raw, fast=label in ("http", "header_of_4_gb"))
sends("md5_that_is_wrong", lambda arena: header(arena, md5sum="0" * 32))
sends("md5_of_a_megabyte", lambda arena: header(arena, md5sum="0" * 2**20))
sends("md5_missing", lambda arena: header(arena, md5sum=None))
sends("service_unknown", lambda arena: header(arena, service="/nothing"))
sends("service_with_nul", lambda arena: header(arena, service="/concave_distance\0/get_distance"))
sends("caller_of_a_megabyte", lambda arena: header(arena, callerid="/" + "c" * 2**20))
sends("header_of_10000_fields", lambda arena: header(arena, **{"f%d" % index: "x" for index in range(10000)}))
for label, length in {"4_gb": 0xffffffff, "2_gb": 0x7fffffff, "1_gb": 1000000000}.items():
    sends("request_of_" + label, lambda arena, length=length: header(arena) + struct.pack("<I", length) + b"x" * 1000,
          growth_mb=1300.0)  # roscpp reserves the memory that a client announces, up to 1 GB
sends("request_of_no_length", lambda arena: header(arena) + struct.pack("<I", 0))
sends("request_cut_in_half", lambda arena: header(arena) + struct.pack("<I", 4000) + b"\x05\0\0\0box")


def request_bytes(arena):
    return ros_wire.serialized(arena.services.GetDistanceRequest(query=query(arena)))


def altered(arena, position, value):
    body = bytearray(request_bytes(arena))
    body[position:position + len(value)] = value
    return header(arena) + struct.pack("<I", len(body)) + bytes(body)


sends("name_that_is_said_to_be_4_gb", lambda arena: altered(arena, 0, b"\xff" * 4))
sends("name_that_is_said_to_end_beyond_the_request", lambda arena: altered(arena, 0, struct.pack("<I", 100000)))
sends("frame_that_is_said_to_be_2_gb", lambda arena: altered(arena, 29, b"\xff\xff\xff\x7f"))


@group.attack()
def array_that_is_said_to_have_4e9_entries(arena):
    uri = arena.node.service_uri("get_distances")
    # AddressSanitizer ends a program that asks for more memory than there is.
    body = struct.pack("<I", 1 << 20 if arena.sanitized else 0xffffffff)
    try:
        ros_wire.call_bytes(uri, arena.node.name + "/get_distances", arena.services.GetDistances._md5sum, body, 20.0)
    except ros_wire.CallFailed:
        pass
    require_sound(ask(arena))


# roscpp makes as many elements as an array says before it looks for their bytes (doc/security.md).
@group.attack(deadline=60.0, growth_mb=800.0)
def request_with_every_byte_changed_in_turn(arena):
    body = request_bytes(arena)
    uri = arena.node.service_uri(SERVICE)
    for position in range(len(body)):
        changed = bytearray(body)
        changed[position] ^= 0xff
        try:
            ros_wire.call_bytes(uri, arena.node.name + "/" + SERVICE, arena.services.GetDistance._md5sum, bytes(changed),
                                10.0)
        except ros_wire.CallFailed as problem:
            expect("no answer" not in str(problem), "byte %d: %s" % (position, problem))
    require_sound(ask(arena))


@group.attack(deadline=60.0)
def hundred_sockets_that_hang(arena):
    """Half a request each, then nothing; meanwhile others are served."""
    opened = []
    try:
        for index in range(100):
            connection = connect(arena)
            connection.sendall(header(arena)[:20 + index])
            opened.append(connection)
        for _ in range(20):
            require_sound(ask(arena))
        arena.require_tracking()
    finally:
        for connection in opened:
            connection.close()


@group.attack(deadline=60.0)
def clients_that_never_read_the_answer(arena):
    opened = []
    body = request_bytes(arena)
    try:
        for _ in range(50):
            connection = connect(arena)
            connection.sendall(header(arena) + struct.pack("<I", len(body)) + body)
            opened.append(connection)
        for _ in range(20):
            require_sound(ask(arena))
    finally:
        for connection in opened:
            connection.close()


@group.attack(deadline=90.0)
def two_thousand_connections_one_after_another(arena):
    for _ in range(2000):
        connect(arena).close()
    require_sound(ask(arena))


# XML-RPC: the node's slave API

XML = "<?xml version='1.0'?><methodCall><methodName>%s</methodName><params>%s</params></methodCall>"
BODIES = {
    "empty": "", "text": "hello", "not_closed": "<methodCall><methodName>getPid", "binary": "\0\1\2\3" * 1000,
    "deep": "<methodCall>" + "<params>" * 50000, "method_of_a_megabyte": XML % ("m" * 2**20, ""),
    "unknown_method": XML % ("formatDisk", ""), "without_parameters": XML % ("publisherUpdate", ""),
    "request_topic_of_numbers": XML % ("requestTopic", "<param><value><int>1</int></value></param>" * 3),
    "deep_array": XML % ("publisherUpdate", "<param><value>" + "<array><data><value>" * 5000),
    "entities": "<!DOCTYPE x [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;'>]>" + XML % ("getPid", "&b;"),
    "base64": XML % ("getPid", "<param><value><base64>" + "!" * 100000 + "</base64></value></param>"),
    "double_1e999": XML % ("getPid", "<param><value><double>1e999</double></value></param>"),
}


def post(arena, body, length=None):
    host, port = ros_wire.address_of(arena.node.slave_uri())
    connection = http.client.HTTPConnection(host, port, timeout=2.0)
    try:
        connection.putrequest("POST", "/RPC2")
        connection.putheader("Content-Type", "text/xml")
        connection.putheader("Content-Length", str(len(body) if length is None else length))
        connection.endheaders(body.encode())
        connection.getresponse().read(10000)
    except (OSError, http.client.HTTPException):
        pass
    finally:
        connection.close()
    require_sound(ask(arena))


for label, text in BODIES.items():
    group.add("slave_api_" + label, lambda arena, body=text: post(arena, body))
for label, announced in {"negative": -1, "4_gb": 2**32, "huge": 10**30, "no_number": "many"}.items():
    group.add("slave_api_content_length_" + label, lambda arena, announced=announced: post(arena, "<x/>", announced))


@group.attack(deadline=60.0)
def publishers_that_are_not_there(arena):
    """publisherUpdate with addresses that do not answer."""
    slave = ros_wire.xmlrpc_proxy(arena.node.slave_uri())
    uris = ["http://localhost:1/", "http://256.256.256.256:1/", "not a uri", "", "http://[::1]:99999/", "http://localhost:0/"]
    slave.publisherUpdate("/master", "/tf", uris + ["http://localhost:%d/" % port for port in range(2, 50)])
    slave.publisherUpdate("/master", "/nothing", uris)
    slave.paramUpdate("/master", "/use_sim_time", "maybe")
    nodes = next((nodes for topic, nodes in arena.master().getSystemState("/faults")[2][0] if topic == "/tf"), [])
    slave.publisherUpdate("/master", "/tf", [arena.master().lookupNode("/faults", node)[2] for node in nodes])
    arena.require_tracking(30.0)


# Topics

def topic_uri(arena, topic):
    """The address at which the node serves a topic."""
    slave = ros_wire.xmlrpc_proxy(arena.node.slave_uri())
    code, text, protocol = slave.requestTopic("/faults_raw", arena.node.name + "/" + topic, [["TCPROS"]])
    expect(code == 1, "the node does not offer %s: %s" % (topic, text))
    return "rosrpc://%s:%d" % (protocol[1], protocol[2])


def subscription(arena, name, message_class, **changes):
    fields = {"callerid": "/faults_raw", "topic": arena.node.name + "/" + name, "md5sum": message_class._md5sum,
              "type": message_class._type}
    fields.update(changes)
    return ros_wire.connection_header(**fields)


@group.attack(deadline=60.0)
def subscribers_that_never_read(arena):
    """Fifty of them on the largest topic: the node drops what they do not read."""
    uri = topic_uri(arena, "niches")
    opened = []
    try:
        for _ in range(50):
            connection = connect(arena, uri)
            connection.sendall(subscription(arena, "niches", arena.messages.Niches))
            opened.append(connection)
        time.sleep(10.0)
        arena.require_tracking()
    finally:
        for connection in opened:
            connection.close()


@group.attack()
def subscriptions_that_are_wrong(arena):
    uri = topic_uri(arena, "distances")
    for changes in ({"md5sum": "0" * 32}, {"topic": "/nothing"}, {"type": "std_msgs/String"}, {"md5sum": "*", "type": "*"},
                    {"topic": ""}, {"callerid": "\xff" * 1000}):
        send(arena, subscription(arena, "distances", arena.messages.Distances, **changes), 0.3, uri)
    for raw in RAW.values():
        send(arena, raw, 0.1, uri)


@group.attack(deadline=60.0)
def three_hundred_subscribers_that_come_and_go(arena):
    def visit():
        for _ in range(10):
            try:
                uri = topic_uri(arena, "niches")
                with connect(arena, uri) as connection:
                    connection.sendall(subscription(arena, "niches", arena.messages.Niches))
                    connection.recv(1000)
            except OSError:
                pass
    threads = [threading.Thread(target=visit, daemon=True) for _ in range(30)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(50.0)
    arena.require_tracking()


@group.attack(deadline=60.0, storms=False)
def publisher_of_another_type_on_tf(arena):
    """The master allows it; the node goes on with the transforms it understands."""
    from std_msgs.msg import String
    master = arena.master()
    uri = rospy.core.get_node_uri()
    master.registerPublisher("/faults_string", "/tf", "std_msgs/String", uri)
    try:
        publisher = rospy.Publisher("/tf_text", String, queue_size=1)
        publisher.publish("x" * 1000)
        arena.require_tracking()
    finally:
        master.unregisterPublisher("/faults_string", "/tf", uri)


@group.attack()
def services_called_with_each_others_types(arena):
    for service, other in (("add_body", "GetDistance"), ("get_distance", "AddBody"), ("list_bodies", "SetEffects")):
        other_class = getattr(arena.services, other)
        try:
            arena.node.call(service, other_class)
        except Failed as problem:
            arena.node.require_alive()
            expect("no answer" not in str(problem), str(problem))
        else:
            raise Failed("%s answered a request of %s" % (service, other))
    call(arena, "list_bodies")
