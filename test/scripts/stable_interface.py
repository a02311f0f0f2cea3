#!/usr/bin/env python3
"""Compares what users build on (doc/stability.md) with stable_interface.txt, the list of what has been promised.

    test/scripts/stable_interface.py PROGRAMS [--write]

PROGRAMS is the folder of the built tools, whose --help gives their options. --write writes the list anew, after a change
that is meant. Names are read from the sources, so that what is deleted or renamed anywhere is seen here.
"""
import argparse
import ast
import glob
import os
import re
import subprocess
import sys
import textwrap
import xml.etree.ElementTree

PACKAGE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(PACKAGE, "test", "scripts"))
from public_names import public_names  # noqa: E402

LIST = os.path.join(PACKAGE, "test", "scripts", "stable_interface.txt")
TOOLS = ["clearance_query", "distance_bag", "distance_query", "mesh_tool", "simulate"]
WITH_ROS = "distance_bag"  # a build without ROS has not this one
TABLES = ["parameters.md", "scene_file.md", "simulation_node.md", "velocity_guard.md"]


def text_of(*place):
    with open(os.path.join(PACKAGE, *place), encoding="utf-8") as stream:
        return stream.read()


def files(pattern):
    return sorted(glob.glob(os.path.join(PACKAGE, pattern), recursive=True))


def packages_with_messages():
    """Where genmsg looks for the messages of other packages."""
    places = {"concave_distance": [os.path.join(PACKAGE, "msg")]}
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(":") + ["/opt/ros/noetic", "/usr"]
    for name in ("geometry_msgs", "sensor_msgs", "shape_msgs", "std_msgs", "trajectory_msgs"):
        folders = [os.path.join(prefix, "share", name, "msg") for prefix in prefixes if prefix]
        places[name] = [folder for folder in folders if os.path.isdir(folder)][:1]
    return places


def md5sums():
    """Of every message and service; without genmsg, as where ROS is not, nothing."""
    try:
        import genmsg
    except ImportError:
        return
    context = genmsg.MsgContext.create_default()
    for kind, folder, load in (("message", "msg", genmsg.msg_loader.load_msg_from_file),
                               ("service", "srv", genmsg.msg_loader.load_srv_from_file)):
        for path in files("%s/*.%s" % (folder, folder)):
            name = os.path.splitext(os.path.basename(path))[0]
            spec = load(context, path, "concave_distance/" + name)
            genmsg.msg_loader.load_depends(context, spec, packages_with_messages())
            yield kind, name, genmsg.compute_md5(context, spec)


def topics():
    """Names that nodes advertise and subscribe to, with the folder of their sources."""
    call = re.compile(r'\b(advertiseService|advertise|subscribe)\s*(?:<[\w:]+>)?\(\s*(?:\w+,\s*)?(?:name \+ )?"([^"]+)"')
    for path in files("src/ros/*/*.cpp"):
        folder = os.path.basename(os.path.dirname(path))
        if folder != "demo":
            for act, name in call.findall(text_of(path)):
                yield ("service name" if act == "advertiseService" else "topic"), folder, name


def parameters():
    """Names and defaults from the tables, which other tests compare with the declarations."""
    for page in TABLES:
        for table, rows in re.findall(r"<!-- table: (\w+) -->\n(.*?)<!-- end -->", text_of("doc", page), re.DOTALL):
            for name, default in re.findall(r"^\| `([\w/.]+)`\*? \| (.*?) \|", rows, re.MULTILINE):
                yield "parameter", table, "%s=%s" % (name, re.sub(r"[`\s]", "", default))


def scene_keys():
    for path in files("src/loading/*.cpp"):
        for key in re.findall(r'\btake\w*\("(\w+)"', text_of(path)):
            yield "scene key", os.path.splitext(os.path.basename(path))[0], key
    for name, _ in re.findall(r'^      \{"(\w+)",\n\s+\{(\{"\w+")', text_of("src/mesh/surface/primitive_table.cpp"), re.M):
        yield "scene key", "primitive", name


def headers():
    for path in files("include/**/*.h"):
        header = os.path.relpath(path, os.path.join(PACKAGE, "include", "concave_distance"))
        for scope, name in public_names(text_of(path)):
            yield "c++", " ".join([header] + scope), name


def python_names():
    for node in ast.parse(text_of("src/python/package/__init__.pyi")).body:
        if isinstance(node, ast.FunctionDef):
            yield "python", "functions", signature(node)
        elif isinstance(node, ast.ClassDef):
            for part in node.body:
                if isinstance(part, ast.FunctionDef):
                    yield "python", node.name, signature(part)
                elif isinstance(part, ast.Assign):
                    yield "python", node.name, "%s=%s" % (part.targets[0].id, ast.literal_eval(part.value))
                elif isinstance(part, ast.AnnAssign):
                    yield "python", node.name, part.target.id


def signature(function):
    arguments = function.args
    names = [argument.arg for argument in arguments.args + arguments.kwonlyargs if argument.arg != "self"]
    return "%s(%s)" % (function.name, ",".join(names))


def tools_in(programs):
    return [tool for tool in TOOLS if tool != WITH_ROS or os.path.exists(os.path.join(programs, tool))]


def options(programs):
    """What --help lists, and the columns of the tools' files."""
    for tool in tools_in(programs):
        program = os.path.join(programs, tool)
        texts = [help_of(program)]
        if tool == "mesh_tool":
            commands = re.findall(r"^  (\w+) +\w", texts[0].split("Subcommands:")[1], re.MULTILINE)
            texts += [help_of(program, command) for command in commands]
            for command in commands:
                yield "option", tool, command
        for text in texts:
            for option in re.findall(r"^  (?:-\w, ?)?(--[\w-]+)", text, re.MULTILINE):
                yield "option", tool, option
    for path in files("src/tools/*.cpp"):
        joined = re.sub(r'"\s*\n\s*"', "", text_of(path))
        for columns in re.findall(r'"((?:\w+,){2,}\w+)"', joined):
            for column in columns.split(","):
                yield "column", os.path.splitext(os.path.basename(path))[0], column


def help_of(*command):
    run = subprocess.run(list(command) + ["--help"], stdout=subprocess.PIPE, check=True)
    return run.stdout.decode("utf-8")


def launch_arguments():
    for path in files("launch/*.launch"):
        for argument in xml.etree.ElementTree.parse(path).getroot().findall("arg"):
            if "value" not in argument.attrib:
                yield "launch", os.path.basename(path), argument.attrib["name"]


def interface(programs):
    """(kind, owner) -> names, as they are now."""
    found = {}
    for part in (md5sums(), topics(), parameters(), scene_keys(), headers(), python_names(), options(programs),
                 launch_arguments()):
        for kind, owner, name in part:
            found.setdefault((kind, owner), set()).add(name)
    return found


def written(found):
    lines = []
    for (kind, owner), names in sorted(found.items()):
        head = "%s | %s | " % (kind, owner)
        lines += [head + part for part in textwrap.wrap(" ".join(sorted(names)), 150 - min(len(head), 60),
                                                        break_long_words=False, break_on_hyphens=False)]
    return "\n".join(lines) + "\n"


def promised():
    found = {}
    for line in text_of(LIST).splitlines():
        kind, owner, names = line.split(" | ")
        found.setdefault((kind, owner), set()).update(names.split())
    return found


def differences(before, now):
    """What is gone and what is new, each in words."""
    gone = [(key, name) for key in before for name in before[key] - now.get(key, set())]
    new = [(key, name) for key in now for name in now[key] - before.get(key, set())]
    return ([" - ".join(key) + ": " + name for key, name in sorted(group)] for group in (gone, new))


def version_faults(programs):
    version = re.search(r"<version>(.*)</version>", text_of("package.xml")).group(1)
    newest = re.search(r"^(Forthcoming|[0-9.]+ \(.*\))\n-+$", text_of("CHANGELOG.rst"), re.MULTILINE).group(1)
    if newest != "Forthcoming" and newest.split()[0] != version:
        yield "package.xml says version %s, the newest section of CHANGELOG.rst %s" % (version, newest)
    for tool in tools_in(programs):
        run = subprocess.run([os.path.join(programs, tool), "--version"], stdout=subprocess.PIPE, check=True)
        if run.stdout.decode("utf-8").splitlines()[0] != "concave_distance " + version:
            yield "%s --version says %r, package.xml %s" % (tool, run.stdout, version)
    for library in ("core", "loading"):
        short = ".".join(version.split(".")[:2])
        if not re.search(r"^CONCAVE_DISTANCE_(LOADING_)?%s \{$" % short, text_of("cmake", library + "_symbols.map"), re.M):
            yield "cmake/%s_symbols.map names symbols of another version than %s" % (library, short)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("programs")
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    now = interface(arguments.programs)
    has_all = tools_in(arguments.programs) == TOOLS
    if arguments.write and not has_all:
        parser.error("there is no %s: build with ROS" % WITH_ROS)
    if arguments.write:
        with open(LIST, "w", encoding="utf-8") as stream:
            stream.write(written(now))
        return 0
    before = promised()
    if not has_all and not any(kind == "message" for kind, _ in now):
        before = {key: names for key, names in before.items() if key[0] not in ("message", "service")}
    if not has_all:
        before = {key: names for key, names in before.items() if key[1] != WITH_ROS}
    gone, new = differences(before, now)
    faults = list(version_faults(arguments.programs))
    for fault in faults:
        print("wrong: " + fault)
    for name in gone:
        print("gone or changed: " + name)
    for name in new:
        print("new: " + name)
    if gone:
        print("Users build on what is gone (doc/stability.md): keep it beside the new one, marked as deprecated, for a minor "
              "version at least; or raise the major version in package.xml and the symbol maps, and write into "
              "CHANGELOG.rst, 'Coming from', what users have to change.")
    if gone or new:
        print("What is new is a promise from now on: write it into CHANGELOG.rst and raise the minor version with the next "
              "release. Then, for both:\n    test/scripts/stable_interface.py %s --write" % arguments.programs)
    return 1 if faults or gone or new else 0


if __name__ == "__main__":
    sys.exit(main())
