#!/usr/bin/python3
"""Writes into the documents what the results that they quote say now.

    scripts/refresh_quotes.py [--list] [page ...]      all pages by default; --list changes nothing

A quoted figure (test/scripts/check_results.py) is evaluated; where it is no longer the rounded value, it is replaced in
its text and in the file of figures beside the page by the value to as many significant digits as stood there. Every change is printed: read its
sentence again, because `slower` may have become `faster`. Left to a reader, and the exit status is 1: a number that
stands in its text more often than it is quoted; equal numbers that differ now, unless the comment clearly has the order
of its text; tables compared with a text file as a whole; expressions that match nothing any more.
"""
import argparse
import collections
import dataclasses
import math
import pathlib
import re
import sys

import provenance

sys.path.insert(0, str(provenance.ROOT / "test" / "scripts"))
import check_results  # noqa: E402  (the path comes first)
from check_results import NUMBER  # noqa: E402

TEXT_NUMBER = re.compile(r"(?<![\w.])" + NUMBER)  # not those within names
COMMENTS = re.compile(r"<!--(?:(?!-->).)*-->(?:\s*<!--(?:(?!-->).)*-->)*", re.DOTALL)


@dataclasses.dataclass
class Figure:
    begin: int  # of the number in the file of figures
    token: str
    expression: str
    value: float


def significant_digits(token):
    digits = token.replace(",", "").partition("e")[0].replace(".", "").lstrip("0")
    if "." in token or "e" in token:
        return max(len(digits), 1)
    return max(len(digits.rstrip("0")), min(len(digits), 3), 1)


def with_exponent(value, digits):
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def plain(value, token, digits):
    """Without an exponent."""
    decimals_there = len(token.partition(".")[2])
    if value == 0:
        return f"{0:.{decimals_there}f}"
    if decimals_there > 1 and (float(token) == 1 or round(value, decimals_there) == 1) and value >= 0.1:
        return f"{value:.{decimals_there}f}"  # shares and ratios in a column keep its decimals
    digits = max(digits, min(1 + math.floor(math.log10(value)), 3))  # as check_results.rounding reads whole numbers
    decimals = digits - 1 - math.floor(math.log10(value))
    rounded = round(value, decimals)
    decimals = max(digits - 1 - math.floor(math.log10(rounded)), 0)
    if not decimals_there and rounded == int(rounded) == value:
        decimals = 0
    return f"{rounded:.{decimals}f}"


def rewritten(value, token):
    """The value as the number was written: significant digits, exponent, thousands separators."""
    sign = "-" if value < 0 else ""
    digits, token = significant_digits(token.lstrip("-")), token.lstrip("-")
    value = abs(value)
    if "e" in token:
        return sign + (with_exponent(value, digits) if value else "0")
    text = plain(value, token.replace(",", ""), digits)
    there = float(token.replace(",", ""))
    separated = "," in token if there >= 1000 and value < 10000 or there >= 10000 else float(text) >= 10000
    whole, point, decimals = text.partition(".")
    return sign + (f"{int(whole):,}" if separated else whole) + point + decimals


def figures_of(page, text, marks, sections, recorded):
    """The figures of marks that follow one another, and what cannot be refreshed."""
    figures, by_hand = [], []
    for match in marks:
        for source, figure, begin in sections.get(match[1], []):
            path = (page.parent / source).resolve()
            if not path.exists() or path not in recorded:
                by_hand.append((match.start(), f"{source} is no recorded result"))
                continue
            quoted = check_results.Quoted(check_results.read_result(path), ".csv" in path.suffixes)
            token, _, expression = (piece.strip() for piece in figure.partition("="))
            if figure == "table":
                table = check_results.paragraph_before(text, match.start())
                by_hand += [(match.start(), f"{source}: {fault}") for fault in check_results.check_table(table, quoted)]
            elif expression:
                try:
                    value = float(eval(expression, {"__builtins__": {}}, quoted.names()))
                    figures.append(Figure(begin, token, expression, value))
                except Exception as error:  # any fault of an expression is for a reader
                    by_hand.append((match.start(), f"{token} = {expression}: {type(error).__name__}: {error}"))
    return figures, by_hand


def have_same_order(same, places, figures, numbers):
    """Whether equal figures stand in the text and beside it in the same order, to judge by the numbers that stand there once:
    all of these do, or one is between each two of the equal ones in both."""
    quoted = collections.Counter(figure.token.lstrip("-") for figure in figures)
    written = collections.Counter(number for _, number in numbers)
    single = [number for number in quoted if quoted[number] == written[number] == 1]
    if len(single) > 1 and single == [number for _, number in numbers if number in single]:
        return True

    def between(begin, end, placed):
        return {number for place, number in placed if begin < place < end and number in single}
    beside = [(figure.begin, figure.token.lstrip("-")) for figure in figures]
    return all(between(first.begin, second.begin, beside) & between(place, next_place, numbers)
               for first, second, place, next_place in zip(same, same[1:], places, places[1:]))


def edits_of(figures, numbers):
    """(place, old, new) of each number to be replaced in the page and beside it, and what is left to a reader."""
    in_page, beside, by_hand = [], [], []
    for token in dict.fromkeys(figure.token for figure in figures):
        same = [figure for figure in figures if figure.token == token]
        if all(check_results.is_rounded(figure.value, token) for figure in same):
            continue
        news = [token if check_results.is_rounded(figure.value, token) else rewritten(figure.value, token) for figure in same]
        bare = token.lstrip("-")
        places = [begin for begin, number in numbers if number == bare]
        wanted = ", ".join(f"{new} = {figure.expression}" for figure, new in zip(same, news))
        turned = any(new.startswith("-") != token.startswith("-") for new in news)
        if turned or not places or len(places) > len(same):
            why = "has another sign now" if turned else f"stands {len(places)} times in the text and is quoted {len(same)} times"
            by_hand.append(f"{token} {why}: {wanted}")
        elif len(set(news)) == 1 or len(places) == len(same) and have_same_order(same, places, figures, numbers):
            in_page += [(place, bare, new.lstrip("-")) for place, new in zip(places, news)]
            beside += [(figure.begin, token, new) for figure, new in zip(same, news)]
        else:
            by_hand.append(f"{token} stands for several figures: {wanted}")
    return in_page, beside, by_hand


def with_edits(text, edits):
    for place, old, new in sorted(edits, reverse=True):
        text = text[:place] + new + text[place + len(old):]
    return text


def refreshed(page, text, recorded):
    """The new texts of the page and of its file of figures, and two lists of (place in the page's old text, what was
    changed or is left to a reader)."""
    sections, faults = check_results.read_figures(page)
    in_page, beside, by_hand, changed = [], [], [(0, fault) for fault in faults], []
    previous_end = 0
    for block in COMMENTS.finditer(text):
        paragraph = max(text.rfind("\n\n", 0, block.start()) + 1, previous_end)
        numbers = [(paragraph + match.start(), match[0])
                   for match in TEXT_NUMBER.finditer(text[paragraph:block.start()])]
        marks = check_results.MARK.finditer(text, block.start(), block.end())
        figures, broken = figures_of(page, text, marks, sections, recorded)
        page_edits, edits, left = edits_of(figures, numbers)
        in_page += page_edits
        beside += edits
        by_hand += broken + [(block.start(), what) for what in left]
        changed += [(place, f"{old} -> {new}") for place, old, new in page_edits if old != new]
        previous_end = block.end()
    file = check_results.figures_file(page)
    figures_text = file.read_text(encoding="utf-8") if file.exists() else ""
    return with_edits(text, in_page), with_edits(figures_text, beside), changed, by_hand


def refresh(root, pages, list_only=False):
    """What was changed and what is left to a reader, as lines."""
    rows = provenance.read_manifest(root)
    recorded = {(root / name).resolve() for names in rows for name in names.split(",")}
    changes, left = [], []
    for page in pages:
        if page.resolve() in recorded:  # written by a program
            continue
        text = page.read_text(encoding="utf-8")
        new_text, new_figures, changed, by_hand = refreshed(page, text, recorded)
        if changed and not list_only:
            page.write_text(new_text, encoding="utf-8")
            check_results.figures_file(page).write_text(new_figures, encoding="utf-8")
        for found, lines in ((changed, changes), (by_hand, left)):
            name = page.resolve().relative_to(root.resolve()).as_posix()
            lines += [f"{name}:{text.count(chr(10), 0, place) + 1}: {what}" for place, what in found]
    return changes, left


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help="print what would be changed")
    parser.add_argument("pages", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    changes, left = refresh(provenance.ROOT, options.pages or check_results.pages(provenance.ROOT), options.list)
    for line in changes:
        print(line)
    for line in left:
        print("by hand:", line)
    print(f"{len(changes)} numbers {'to be ' if options.list else ''}replaced, {len(left)} places by hand")
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main())
