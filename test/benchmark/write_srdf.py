#!/usr/bin/env python3
"""Prints an SRDF that leaves a robot so many pairs of links: those farthest from each other along its joints.

    test/benchmark/write_srdf.py URDF PAIRS > robot.srdf

Only links with collision geometry count, and links joined by fixed joints or by one joint are no pair, as in the node.
"""
import argparse
import itertools
import sys
import xml.etree.ElementTree as ElementTree


def pairs_by_joints(robot):
    """Pairs of links as (joints between them, link, link), those with the most joints first."""
    joints = [joint for joint in robot.findall("joint") if joint.find("parent") is not None]
    rigid = {link.get("name"): link.get("name") for link in robot.findall("link")}  # link: what it is one body with

    def body(link):
        return link if rigid[link] == link else body(rigid[link])

    above = {}
    for joint in joints:
        parent, child = joint.find("parent").get("link"), joint.find("child").get("link")
        above[child] = parent
        if joint.get("type") == "fixed":
            rigid[body(child)] = body(parent)

    def chain(link):
        bodies = [body(link)]
        while link in above:
            link = above[link]
            if body(link) != bodies[-1]:
                bodies.append(body(link))
        return bodies

    adjacent = {frozenset((child, parent)) for child, parent in above.items()}
    links = [link.get("name") for link in robot.findall("link") if link.find("collision") is not None]
    pairs = []
    for a, b in itertools.combinations(links, 2):
        if body(a) == body(b) or frozenset((a, b)) in adjacent:
            continue
        common = len(set(chain(a)) & set(chain(b)))
        pairs.append((len(chain(a)) + len(chain(b)) - 2 * common, a, b))
    return sorted(pairs, key=lambda pair: (-pair[0], pair[1:]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("urdf")
    parser.add_argument("pairs", type=int)
    arguments = parser.parse_args()
    robot = ElementTree.parse(arguments.urdf).getroot()
    pairs = pairs_by_joints(robot)
    if len(pairs) < arguments.pairs:
        sys.exit("%s has %d pairs only" % (arguments.urdf, len(pairs)))
    semantics = ElementTree.Element("robot", name=robot.get("name"))
    for _, a, b in pairs[arguments.pairs:]:
        ElementTree.SubElement(semantics, "disable_collisions", link1=a, link2=b, reason="User")
    ElementTree.indent(semantics)
    print(ElementTree.tostring(semantics, encoding="unicode"))


if __name__ == "__main__":
    main()
