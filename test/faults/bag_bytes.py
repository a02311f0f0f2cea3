"""Bags of ROS 1 (format 2.0) byte by byte, so that every count and place in them may lie."""

import bz2
import io
import struct

import ros_wire

BEGIN = 1700000000  # s, of the first message
PLACE_OF_HEAD = 13  # behind the line that says what it is


def record(data, **fields):
    header = b"".join(struct.pack("<I", len(name) + 1 + len(value)) + name.encode() + b"=" + value
                      for name, value in fields.items())
    return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data


def count(number):
    return struct.pack("<I", number % 2**32)


def place(number):
    return struct.pack("<Q", number % 2**64)


def time_of(seconds):
    """Seconds of the epoch, or the bytes themselves."""
    if isinstance(seconds, bytes):
        return seconds
    nanoseconds = int(round((seconds - BEGIN) * 1e9))
    return struct.pack("<II", BEGIN + nanoseconds // 10**9, nanoseconds % 10**9)


def connection(number, on_topic, message_class, **changes):
    fields = {"topic": on_topic.encode(), "type": message_class._type.encode(), "md5sum": message_class._md5sum.encode(),
              "message_definition": message_class._full_text.encode()}
    fields.update(changes)
    body = b"".join(struct.pack("<I", len(name) + 1 + len(value)) + name.encode() + b"=" + value
                    for name, value in fields.items() if value is not None)
    return record(body, op=b"\x07", conn=count(number), topic=on_topic.encode())


class Bag:
    """Chunks of messages. `lies` replace what the bag would say:

    compression, chunk_size (bytes of a chunk when it is read), index_pos, conn_count, chunk_count, chunk_pos, start_time,
    end_time, info_count (connections of a chunk), info_messages (of one), index_count, index_offset, index_ver.
    """

    def __init__(self, **lies):
        self.lies = lies
        self.connections = []
        self.chunks = []  # of lists of (connection, time, bytes)

    def connect(self, on_topic, message_class, **changes):
        number = len(self.connections)
        self.connections.append(connection(number, on_topic, message_class, **changes))
        return number

    def chunk(self):
        self.chunks.append([])

    def write(self, number, seconds, data):
        """data: a message, or its bytes."""
        if not self.chunks:
            self.chunk()
        self.chunks[-1].append((number, seconds, data if isinstance(data, bytes) else ros_wire.serialized(data)))

    def lie(self, name, truth):
        return self.lies.get(name, truth)

    def to_bytes(self):
        out = io.BytesIO()
        out.write(b"#ROSBAG V2.0\n")
        out.write(bytes(4096))
        infos = b"".join(self._write_chunk(out, messages) for messages in self.chunks)
        index_pos = out.tell()
        out.write(b"".join(self.connections) + infos)
        head = record(b"", op=b"\x03", index_pos=place(self.lie("index_pos", index_pos)),
                      conn_count=count(self.lie("conn_count", len(self.connections))),
                      chunk_count=count(self.lie("chunk_count", len(self.chunks))))[:-4]
        head += struct.pack("<I", 4096 - len(head) - 4)
        whole = bytearray(out.getvalue())
        whole[PLACE_OF_HEAD:PLACE_OF_HEAD + 4096] = head.ljust(4096)
        return bytes(whole)

    def _write_chunk(self, out, messages):
        where = out.tell()
        inner = io.BytesIO()
        index = {}
        told = set()
        for number, seconds, data in messages:
            if number not in told:
                told.add(number)
                inner.write(self.connections[number])
            index.setdefault(number, []).append((seconds, inner.tell()))
            inner.write(record(data, op=b"\x02", conn=count(number), time=time_of(seconds)))
        plain = inner.getvalue()
        compression = self.lie("compression", b"none")
        stored = self.lie("stored", bz2.compress(plain) if compression == b"bz2" else plain)
        out.write(record(stored, op=b"\x05", compression=compression, size=count(self.lie("chunk_size", len(plain)))))
        for number, places in sorted(index.items()):
            entries = b"".join(time_of(self.lie("index_time", seconds)) + count(self.lie("index_offset", offset))
                               for seconds, offset in places)
            out.write(record(entries, op=b"\x04", ver=count(self.lie("index_ver", 1)), conn=count(number),
                             count=count(self.lie("index_count", len(places)))))
        times = [seconds for _, seconds, _ in messages if not isinstance(seconds, bytes)] or [BEGIN]
        counts = b"".join(count(number) + count(self.lie("info_messages", len(places)))
                          for number, places in sorted(index.items()))
        return record(counts, op=b"\x06", ver=count(1), chunk_pos=place(self.lie("chunk_pos", where)),
                      start_time=time_of(self.lie("start_time", min(times))),
                      end_time=time_of(self.lie("end_time", max(times))),
                      count=count(self.lie("info_count", len(index))))
