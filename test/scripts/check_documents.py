#!/usr/bin/env python3
"""Fails on a link that leads nowhere, a page that doc/README.md does not list or lists twice, a picture that is shown
twice or not at all, and a README of more than 120 lines.

    test/scripts/check_documents.py
"""
import os
import re
import sys

PACKAGE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LINK = re.compile(r"(!?)\[[^\]]*\]\(([^)\s]+)\)")


def documents():
    for top in ("doc", os.path.join("thesis", "doc")):
        for folder, _, names in os.walk(os.path.join(PACKAGE, top)):
            yield from (os.path.relpath(os.path.join(folder, name), PACKAGE) for name in names)


def pages():
    found = ["README.md", "CONTRIBUTING.md"]
    found += [place for place in documents() if place.endswith(".md")]
    return sorted(found)


def text_of(page):
    with open(os.path.join(PACKAGE, page), encoding="utf-8") as stream:
        return stream.read()


def anchors_of(page):
    anchors = set()
    for title in re.findall(r"^#+ (.*)$", text_of(page), re.MULTILINE):
        plain = re.sub(r"[^\w\- ]", "", title.replace("`", "")).lower()
        anchors.add(plain.strip().replace(" ", "-"))
    return anchors


def main():
    faults = []
    pictures = {}
    index = {}
    for page in pages():
        text = re.sub(r"```.*?```", "", text_of(page), flags=re.DOTALL)
        for mark, target in LINK.findall(text):
            if "://" in target:
                continue
            path, _, anchor = target.partition("#")
            place = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
            if not os.path.exists(os.path.join(PACKAGE, place)):
                faults.append("%s: %s leads nowhere" % (page, target))
                continue
            if anchor and place.endswith(".md") and anchor not in anchors_of(place):
                faults.append("%s: %s has no title #%s" % (page, place, anchor))
            if mark:
                pictures.setdefault(place, []).append(page)
            if page == "doc/README.md":
                index[place] = index.get(place, 0) + 1
    for page in pages():
        if page in ("README.md", "doc/README.md"):
            continue  # the start and the index
        if index.get(page, 0) != 1:
            faults.append("doc/README.md lists %s %d times" % (page, index.get(page, 0)))
    for place in documents():
        if place.endswith(".png") and place not in pictures:
            faults.append("%s is shown nowhere" % place)
    for picture, places in pictures.items():
        if len(places) > 1:
            faults.append("%s is shown %d times: %s" % (picture, len(places), ", ".join(places)))
    if len(text_of("README.md").splitlines()) > 120:
        faults.append("README.md has more than 120 lines")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
