"""ROS 1 on the wire: service calls with a deadline, and connections that break the protocol."""

import io
import socket
import struct
import urllib.parse
import xmlrpc.client


class CallFailed(Exception):
    """A service call without a response: connection refused, error of the node, no answer in time."""


class DeadlineTransport(xmlrpc.client.Transport):
    def __init__(self, timeout):
        super().__init__()
        self.timeout = timeout

    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = self.timeout
        return connection


def xmlrpc_proxy(uri, timeout=10.0):
    return xmlrpc.client.ServerProxy(uri, transport=DeadlineTransport(timeout), allow_none=True)


def address_of(uri):
    parts = urllib.parse.urlparse(uri)
    return parts.hostname, parts.port


def connection_header(**fields):
    """The header of a TCPROS connection; values are texts or bytes."""
    body = b""
    for key, value in fields.items():
        value = value if isinstance(value, bytes) else value.encode()
        field = key.encode() + b"=" + value
        body += struct.pack("<I", len(field)) + field
    return struct.pack("<I", len(body)) + body


def receive(connection, count):
    data = bytearray()
    while len(data) < count:
        part = connection.recv(min(count - len(data), 1 << 20))
        if not part:
            raise CallFailed("the node closed the connection after %d of %d bytes" % (len(data), count))
        data += part
    return bytes(data)


def serialized(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def call_bytes(uri, service, md5sum, body, timeout=10.0):
    """Sends a request as bytes and returns the bytes of the response. Raises CallFailed."""
    try:
        with socket.create_connection(address_of(uri), timeout=timeout) as connection:
            connection.sendall(connection_header(callerid="/faults", service=service, md5sum=md5sum))
            header = receive(connection, struct.unpack("<I", receive(connection, 4))[0])
            if b"error=" in header:
                raise CallFailed("refused: " + header.decode(errors="replace"))
            connection.sendall(struct.pack("<I", len(body)) + body)
            worked = receive(connection, 1)
            answer = receive(connection, struct.unpack("<I", receive(connection, 4))[0])
    except socket.timeout:
        raise CallFailed("no answer within %.0f s" % timeout) from None
    except OSError as problem:
        raise CallFailed("connection: %s" % problem) from None
    if worked != b"\x01":
        raise CallFailed("error: " + answer.decode(errors="replace"))
    return answer


def call(uri, service, service_class, request, timeout=10.0, replace=()):
    """Calls a service. replace: pairs of bytes of equal length, replaced in the request before sending, for values
    that the message classes cannot write."""
    body = serialized(request)
    for old, new in replace:
        if len(old) != len(new) or old not in body:
            raise ValueError("cannot replace %r by %r" % (old, new))
        body = body.replace(old, new)
    answer = call_bytes(uri, service, service_class._md5sum, body, timeout)
    response = service_class._response_class()
    response.deserialize(answer)
    return response
