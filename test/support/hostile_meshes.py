#!/usr/bin/env python3
"""Writes mesh files that try to crash, hang or mislead a reader.

    hostile_meshes.py FOLDER      writes them and prints name, expectation and path

None of them is kept in the repository: every file is generated, most in a few lines. A few are large on disk
(3 to 60 MB) or sparse (64 GB that take no space).
"""

import os
import socket
import struct
import sys
from typing import Callable, List, NamedTuple

REFUSED = "refused"  # an error that names the file; the program goes on
SERVED = "served"    # unusual, but a valid mesh: refusing it would be an error
EITHER = "either"    # served or refused, within the limits; the program goes on


class HostileMesh(NamedTuple):
    name: str
    path: str
    expectation: str


_WRITERS: List = []


def _mesh(file_name: str, expectation: str = REFUSED):
    """For a function that returns the file's content, or writes the file at the given path and returns None."""

    def register(write: Callable):
        _WRITERS.append((file_name, expectation, write))
        return write

    return register


def _refused(file_name: str, write: Callable):
    _WRITERS.append((file_name, REFUSED, write))


def _served(file_name: str, write: Callable):
    _WRITERS.append((file_name, SERVED, write))


def _either(file_name: str, write: Callable):
    _WRITERS.append((file_name, EITHER, write))


# ---------------------------------------------------------------------------------------------- COLLADA

_TRIANGLE_SOURCE = """<source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>"""

_TRIANGLE_FACES = """<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>"""


def _dae(source: str = _TRIANGLE_SOURCE, faces: str = _TRIANGLE_FACES, nodes: str = "", library: str = "",
         prologue: str = '<?xml version="1.0"?>\n', geometries: str = "") -> str:
    nodes = nodes or '<node id="n"><instance_geometry url="#g"/></node>'
    return (f'{prologue}<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
            '<asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>'
            f'<library_geometries><geometry id="g"><mesh>{source}{faces}</mesh></geometry>{geometries}'
            f'</library_geometries>{library}'
            f'<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>'
            '<scene><instance_visual_scene url="#s"/></scene></COLLADA>')


_refused("node_instances_itself.dae", lambda:
         _dae(nodes='<node id="n"><instance_geometry url="#g"/><instance_node url="#n"/></node>'))
_refused("two_nodes_instance_each_other.dae", lambda:
         _dae(nodes='<node id="a"><instance_node url="#b"/></node><node id="b"><instance_node url="#a"/>'
                    '<instance_geometry url="#g"/></node>'))
_refused("library_node_instances_itself.dae", lambda:
         _dae(library='<library_nodes><node id="l"><instance_node url="#l"/><instance_geometry url="#g"/></node>'
                      '</library_nodes>', nodes='<node id="n"><instance_node url="#l"/></node>'))


def _nested_nodes(depth: int) -> str:
    return "<node>" * depth + '<instance_geometry url="#g"/>' + "</node>" * depth


_refused("nodes_20000_deep.dae", lambda: _dae(nodes=_nested_nodes(20_000)))
_refused("nodes_1000000_deep.dae", lambda: _dae(nodes=_nested_nodes(1_000_000)))
_served("nodes_50_deep.dae", lambda: _dae(nodes=_nested_nodes(50)))
_either("unknown_elements_500000_deep.dae", lambda: _dae(library="<x>" * 500_000 + "</x>" * 500_000))


def _doubling_nodes(levels: int) -> str:
    library = '<node id="d0"><instance_geometry url="#g"/></node>'
    for level in range(1, levels + 1):
        library += (f'<node id="d{level}"><instance_node url="#d{level - 1}"/>'
                    f'<instance_node url="#d{level - 1}"/></node>')
    return f"<library_nodes>{library}</library_nodes>"


_refused("unfolds_to_a_billion_nodes.dae", lambda:
         _dae(library=_doubling_nodes(30), nodes='<node id="n"><instance_node url="#d30"/></node>'))
_refused("unfolds_to_30_million_nodes.dae", lambda:
         _dae(library=_doubling_nodes(25), nodes='<node id="n"><instance_node url="#d25"/></node>'))
_served("unfolds_to_1024_triangles.dae", lambda:
        _dae(library=_doubling_nodes(10), nodes='<node id="n"><instance_node url="#d10"/></node>'))


@_mesh("few_nodes_many_triangles.dae")
def _():
    # 4096 instances of 20,000 triangles: few nodes, 82 million triangles.
    faces = ('<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="20000">'
             '<input semantic="VERTEX" source="#v" offset="0"/><p>' + "0 1 2 " * 20_000 + "</p></triangles>")
    return _dae(faces=faces, library=_doubling_nodes(12), nodes='<node id="n"><instance_node url="#d12"/></node>')


_refused("accessor_of_4e9.dae", lambda:
         _dae(source=_TRIANGLE_SOURCE.replace('source="#a" count="3"', 'source="#a" count="4000000000"')))
_refused("accessor_with_huge_stride.dae", lambda:
         _dae(source=_TRIANGLE_SOURCE.replace('stride="3"', 'stride="4294967295"')))
_refused("accessor_with_huge_offset.dae", lambda:
         _dae(source=_TRIANGLE_SOURCE.replace('stride="3"', 'stride="3" offset="4294967290"')))
_refused("float_array_of_4e9.dae", lambda:
         _dae(source=_TRIANGLE_SOURCE.replace('id="a" count="9"', 'id="a" count="4000000000"')))
_refused("float_array_count_negative.dae", lambda:
         _dae(source=_TRIANGLE_SOURCE.replace('id="a" count="9"', 'id="a" count="-1"')))
_either("triangles_of_4e9.dae", lambda:
        _dae(faces=_TRIANGLE_FACES.replace('triangles count="1"', 'triangles count="4000000000"')))
_refused("index_list_without_numbers.dae", lambda:
         _dae(faces=_TRIANGLE_FACES.replace("<p>0 1 2</p>", "<p>0 1 two</p>")))
_refused("index_out_of_range.dae", lambda: _dae(faces=_TRIANGLE_FACES.replace("<p>0 1 2</p>", "<p>0 1 4294967295</p>")))
_refused("input_offset_of_4e9.dae", lambda: _dae(faces=_TRIANGLE_FACES.replace('offset="0"', 'offset="4294967295"')))
_refused("index_that_overflows.dae", lambda:
         _dae(faces=_TRIANGLE_FACES.replace("<p>0 1 2</p>", "<p>0 1 99999999999999999999999</p>")))
_refused("polylist_with_a_count_of_4e9.dae", lambda:
         _dae(faces='<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><polylist count="1">'
                    '<input semantic="VERTEX" source="#v" offset="0"/><vcount>4000000000</vcount><p>0 1 2</p></polylist>'))
_refused("source_refers_to_itself.dae", lambda:
         _dae(faces='<vertices id="v"><input semantic="POSITION" source="#v"/></vertices><triangles count="1">'
                    '<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>'))
_refused("three_million_open_brackets.dae", lambda: "<" * 3_000_000)
_refused("three_million_open_brackets_and_one_closed.dae", lambda: "<" * 3_000_000 + ">")
_refused("three_million_tags.dae", lambda: "<p>" * 1_000_000 + ">" * 1_000_000)
_refused("half_a_million_open_tags.dae", lambda: "<p>" * 500_000)
_refused("comments_never_closed.dae", lambda: "<!--" * 750_000)


@_mesh("entity_bomb.dae", EITHER)
def _():
    entities = '<!ENTITY e0 "0 1 2 ">' + "".join(
        f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 12))
    return _dae(prologue=f'<?xml version="1.0"?>\n<!DOCTYPE COLLADA [{entities}]>\n',
                faces=_TRIANGLE_FACES.replace("0 1 2", "0 1 2 &e11;"))


_either("external_entity.dae", lambda:
        _dae(prologue='<?xml version="1.0"?>\n<!DOCTYPE COLLADA [<!ENTITY x SYSTEM "file:///etc/passwd">]>\n',
             nodes='<node id="n" name="&x;"><instance_geometry url="#g"/></node>'))
_refused("controller_refers_to_itself.dae", lambda:
         _dae(library='<library_controllers><controller id="c"><skin source="#c"><joints/><vertex_weights count="1">'
                      '<vcount>1</vcount><v>0 0</v></vertex_weights></skin></controller></library_controllers>',
              nodes='<node id="n"><instance_controller url="#c"/></node>'))
_either("an_attribute_of_10_mb.dae", lambda:
        _dae(nodes='<node id="n" name="' + "x" * 10_000_000 + '"><instance_geometry url="#g"/></node>'))
_refused("matrix_of_nan.dae", lambda:
         _dae(nodes='<node id="n"><matrix>' + "nan " * 16 + '</matrix><instance_geometry url="#g"/></node>'))
_refused("a_zip_archive.dae", lambda: b"PK\x03\x04" + bytes(2000))


# -------------------------------------------------------------------------------------------------- PLY


def _ply(vertices: str = "3", faces: str = "1", vertex_type: str = "float", list_types: str = "uchar int",
         body: str = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", form: str = "ascii", more: str = "") -> str:
    axes = "".join(f"property {vertex_type} {axis}\n" for axis in "xyz")
    return (f"ply\nformat {form} 1.0\nelement vertex {vertices}\n{axes}{more}element face {faces}\n"
            f"property list {list_types} vertex_indices\nend_header\n{body}")


_refused("unknown_property_type_and_endless_vertices.ply", lambda:
         _ply(vertices="18446744073709551615", vertex_type="tensor", form="binary_little_endian"))
_refused("endless_vertices_without_properties.ply", lambda:
         "ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\nend_header\n")
_refused("endless_vertices.ply", lambda: _ply(vertices="18446744073709551615"))
_refused("four_billion_binary_vertices.ply", lambda: _ply(vertices="4294967295", form="binary_little_endian"))
# 12 bytes times 2^62 is 0 in 64 bits.
_refused("product_that_wraps_round.ply", lambda:
         _ply(vertices="4611686018427387904", form="binary_little_endian", body=""))
_refused("a_list_of_4e9.ply", lambda: _ply(list_types="uint int", body="0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n"))
_refused("a_list_with_a_negative_count.ply", lambda: _ply(list_types="int int", body="0 0 0\n1 0 0\n0 1 0\n-1 0 1 2\n"))
_refused("header_without_end.ply", lambda: "ply\nformat ascii 1.0\n" + "comment for ever\n" * 300_000)
_refused("a_header_line_of_20_mb.ply", lambda: "ply\nformat ascii 1.0\ncomment " + "x" * 20_000_000)
_refused("a_million_properties.ply", lambda: _ply(vertices="1000000", more="property float q\n" * 100_000))
_refused("a_million_elements.ply", lambda: "ply\nformat ascii 1.0\n" + "element vertex 1\n" * 300_000 + "end_header\n")
_refused("coordinates_not_finite.ply", lambda: _ply(body="0 0 0\n1e999 0 0\n0 nan 0\n3 0 1 2\n"))


# -------------------------------------------------------------------------------------------------- OBJ

_OBJ_TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@_mesh("material_library_is_a_fifo.obj", SERVED)
def _(path):
    fifo = os.path.join(os.path.dirname(path), "fifo.mtl")
    if not os.path.exists(fifo):
        os.mkfifo(fifo)
    _write(path, "mtllib fifo.mtl\n" + _OBJ_TRIANGLE)


_served("material_library_is_endless.obj", lambda: "mtllib /dev/zero\n" + _OBJ_TRIANGLE)
_served("material_library_is_itself.obj", lambda: "mtllib material_library_is_itself.obj\n" + _OBJ_TRIANGLE)
_served("a_thousand_material_libraries.obj", lambda:
        "".join(f"mtllib /proc/{i}/environ\n" for i in range(1000)) + _OBJ_TRIANGLE)
_refused("index_that_overflows.obj", lambda: _OBJ_TRIANGLE + "f 1 2 99999999999999999999999\n")
_either("a_face_of_a_million_corners.obj", lambda: _OBJ_TRIANGLE + "f" + " 1 2 3" * 333_333 + "\n")
_refused("a_line_of_30_mb.obj", lambda: "v " + "1" * 30_000_000)
_refused("line_that_always_goes_on.obj", lambda: _OBJ_TRIANGLE + "f 1 2 \\\n" * 1_000_000)
_either("a_million_objects.obj", lambda:
        "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "".join(f"o x{i}\nf 1 2 3\n" for i in range(300_000)))
_refused("slashes_alone.obj", lambda: "v 0 0 0\nv 1 0 0\nv 0 1 0\nf // // //\nf / / /\n")
_refused("binary_zeros.obj", lambda: bytes(1_000_000))
_refused("coordinates_not_finite.obj", lambda: "v 0 0 0\nv 1e999 0 0\nv 0 -1e999 0\nf 1 2 3\n")


# -------------------------------------------------------------------------------------------------- STL


def _binary_stl(announced: int, facets: int, header: bytes = b"") -> bytes:
    facet = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    return header.ljust(80, b" ") + struct.pack("<I", announced) + facet * facets


_refused("announces_4e9_facets.stl", lambda: _binary_stl(0xFFFFFFFF, 3))


@_mesh("facets_in_a_sparse_file.stl")
def _(path):
    # The file has the announced size, but is sparse: 64 GB that take no space.
    facets = 1_374_000_000
    _write(path, _binary_stl(facets, 0))
    os.truncate(path, 84 + 50 * facets)


@_mesh("a_sparse_file_of_zeros.stl")
def _(path):
    _write(path, b"")
    os.truncate(path, 64_000_000_000)


_refused("a_solid_without_end.stl", lambda: "solid x\n" + "facet normal 0 0 1\nouter loop\n" * 300_000)
_refused("three_million_solids.stl", lambda: "solid x\n" * 1_000_000)
_either("facets_outside_of_loops.stl", lambda: "solid x\n" + "vertex 0 0 0\n" * 300_000 + "endsolid x\n")


@_mesh("numbers_of_a_million_digits.stl", EITHER)
def _():
    number = "1" * 1_000_000
    return (f"solid x\nfacet normal 0 0 1\nouter loop\nvertex {number} 0 0\nvertex 0 {number} 0\nvertex 0 0 0.{number}\n"
            "endloop\nendfacet\nendsolid x\n")


@_mesh("corners_not_finite.stl")
def _():
    facet = struct.pack("<12fH", 0, 0, 1, *[float("nan")] * 9, 0)
    return b" " * 80 + struct.pack("<I", 1) + facet


# -------------------------------------------------------------------- other formats under a mesh's name


_refused("gltf_with_a_buffer_elsewhere.obj", lambda:
         '{"asset":{"version":"2.0"},"buffers":[{"byteLength":4000000000,"uri":"/dev/zero"}],'
         '"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]}')
_refused("blender_file.stl", lambda: b"BLENDER-v248" + bytes(range(256)) * 40)
_refused("quake_model.ply", lambda: b"IDP2" + struct.pack("<16i", *[0x7FFFFFFF] * 16))
_refused("a_scene.fbx", lambda: b"Kaydara FBX Binary  \x00\x1a\x00" + bytes(200))
_refused("a_scene.gltf", lambda: '{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}]}')
_refused("an_archive.zae", lambda: b"PK\x05\x06" + bytes(18))
_refused("no_ending_at_all", lambda: _OBJ_TRIANGLE)


# -------------------------------------------------------------------------------- files that are not regular


@_mesh("a_fifo.stl")
def _(path):
    if not os.path.exists(path):
        os.mkfifo(path)


@_mesh("a_folder.obj")
def _(path):
    os.makedirs(path, exist_ok=True)


@_mesh("a_socket.stl")
def _(path):
    if os.path.exists(path):
        return
    # The name of a socket holds 107 bytes: bound by a relative path.
    here = os.getcwd()
    os.chdir(os.path.dirname(path))
    try:
        with socket.socket(socket.AF_UNIX) as listener:
            listener.bind(os.path.basename(path))
    finally:
        os.chdir(here)


def _link(target: str):
    def write(path):
        if not os.path.islink(path):
            os.symlink(target, path)

    return write


_refused("link_to_zeros.stl", _link("/dev/zero"))
_refused("link_to_random.ply", _link("/dev/urandom"))
_refused("link_to_the_terminal.obj", _link("/dev/tty"))
_refused("link_to_memory.stl", _link("/proc/self/mem"))
_refused("link_to_a_password_file.obj", _link("/etc/passwd"))
_refused("link_to_nothing.dae", _link("no_such_file.dae"))
_refused("link_to_itself.ply", _link("link_to_itself.ply"))
_refused("empty.dae", lambda: b"")


@_mesh("unreadable.stl", EITHER)
def _(path):
    # Root can still read it.
    _write(path, _binary_stl(2, 2))
    os.chmod(path, 0)


def _write(path: str, content) -> None:
    with open(path, "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())


def write_hostile_meshes(folder: str) -> List[HostileMesh]:
    """Makes `folder` and writes every file below it; a second call writes the same files."""
    folder = os.path.abspath(folder)
    os.makedirs(folder, exist_ok=True)
    meshes = []
    for file_name, expectation, write in _WRITERS:
        path = os.path.join(folder, file_name)
        if os.path.isfile(path) and not os.path.islink(path):
            os.remove(path)
        if write.__code__.co_argcount == 1:
            write(path)
        else:
            _write(path, write())
        meshes.append(HostileMesh(file_name, path, expectation))
    return meshes


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for hostile in write_hostile_meshes(sys.argv[1]):
        print(f"{hostile.expectation:8} {hostile.name:50} {hostile.path}")
