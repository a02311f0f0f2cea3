#!/usr/bin/env python3
"""Writes a C++ program that needs every function which the installed headers declare and do not define.

    list_public_functions.py INCLUDE_FOLDER OUTPUT.cpp

Who links it sees the functions that the libraries do not export. Templates and inline functions are left out: they
are in the headers."""
import pathlib
import re
import sys

NOT_A_FUNCTION = ("using", "typedef", "friend", "template", "static_assert", "enum", "extern", "namespace")


def without_comments(text):
    text = re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"', " ", text, flags=re.S)
    return re.sub(r"^[ \t]*#(?:\\\n|[^\n])*", " ", text, flags=re.M)


def closing(text, begin):
    """Place behind the bracket that closes the one at begin."""
    pairs = {"{": "}", "(": ")"}
    depth = 0
    for place in range(begin, len(text)):
        if text[place] == text[begin]:
            depth += 1
        elif text[place] == pairs[text[begin]]:
            depth -= 1
            if depth == 0:
                return place + 1
    raise ValueError("a bracket is not closed: " + text[begin : begin + 60])


def open_parenthesis(statement):
    """Place of the one that begins the parameters; None when the statement declares no function."""
    operator = re.search(r"\boperator\s*(?:\(\)|[^\s\w(]+|\s[\w:]+)", statement)
    if operator:
        return statement.index("(", operator.end())
    depth = 0
    for place, character in enumerate(statement):
        if character == "<":
            depth += 1
        elif character == ">":
            depth -= 1
        elif character == "=" and depth == 0:
            return None
        elif character == "(" and depth == 0:
            return place
    return None


def without_defaults(parameters):
    """The parameters without their default arguments."""
    kept, depth, in_default = "", 0, False
    for character in parameters:
        if character in "<({[":
            depth += 1
        elif character in ">)}]":
            depth -= 1
        elif depth == 0 and character == "=":
            in_default = True
        elif depth == 0 and character == ",":
            in_default = False
        if not in_default:
            kept += character
    return " ".join(kept.split())


def takes_by_value(parameters, types):
    """Whether a parameter, not a reference or a pointer, is of one of these types."""
    depth, part, parts = 0, "", []
    for character in parameters + ",":
        depth += (character in "<({") - (character in ">)}")
        if character == "," and depth == 0:
            parts.append(part)
            part = ""
        else:
            part += character
    return any(words and words[0] in types for words in (re.findall(r"[\w&*]+", part) for part in parts))


class Scope:
    def __init__(self, kind, name, is_public=True, is_template=False):
        self.kind, self.name, self.is_public, self.is_template = kind, name, is_public, is_template


class Scan:
    """The declared functions of one header: (class or "", returned type, name, parameters, what follows them)."""

    def __init__(self, text):
        self.text = without_comments(text)
        self.scopes = [Scope("namespace", "")]
        self.functions = []
        self.declared, self.defined = set(), set()  # types
        self.statement = ""
        self.run()

    def run(self):
        place = 0
        while place < len(self.text):
            character = self.text[place]
            place += 1
            if character == ";":
                self.end_statement()
            elif character == "(":
                end = closing(self.text, place - 1)
                self.statement += self.text[place - 1 : end]
                place = end
            elif character == "{":
                place = self.open_brace(place - 1)
            elif character == "}":
                self.scopes.pop()
                self.statement = ""
            elif character == ":" and self.statement.strip() in ("public", "protected", "private"):
                self.scopes[-1].is_public = self.statement.strip() == "public"
                self.statement = ""
            else:
                self.statement += character

    def open_brace(self, begin):
        head = " ".join(self.statement.split())
        block = re.match(r"(?:template\s*<.*>\s*)?(namespace|class|struct)\b\s*([\w:]*)", head)
        if block and open_parenthesis(head) is None:
            kind = "namespace" if block[1] == "namespace" else "class"
            self.defined.add(block[2])
            self.scopes.append(Scope(kind, block[2], block[1] != "class", head.startswith("template")))
            self.statement = ""
            return begin + 1
        end = closing(self.text, begin)
        if open_parenthesis(head) is None or re.match(r"enum\b", head):
            self.statement += " "  # an initial value or an enumeration, up to the semicolon
        elif not re.match(r"\s*[,{]", self.text[end:]):  # else the list of initial values of a constructor
            self.statement = ""
        return end

    def end_statement(self):
        statement, self.statement = " ".join(self.statement.split()), ""
        statement = re.sub(r"\[\[\w+\]\]\s*", "", statement)
        forward = re.fullmatch(r"(?:class|struct) (\w+)", statement)
        if forward:
            self.declared.add(forward[1])
        begin = open_parenthesis(statement)
        if begin is None or statement.split()[0] in NOT_A_FUNCTION or re.search(r"\bconstexpr\b", statement):
            return
        end = closing(statement, begin)
        behind = statement[end:].strip()
        if "=" in behind or any(scope.is_template or not scope.is_public for scope in self.scopes):
            return  # of this class, or one around it, users reach nothing; or it is defaulted or deleted
        head = re.fullmatch(r"(?P<before>.*?)(?P<name>~?\w+|operator\s*\S+)", statement[:begin].strip())
        words = head["before"].split()
        owner = "::".join(scope.name for scope in self.scopes if scope.kind == "class")
        returned = " ".join(word for word in words if word not in ("explicit", "static", "virtual", "inline"))
        parameters = without_defaults(statement[begin + 1 : end - 1])
        behind = " ".join(word for word in behind.split() if word in ("const", "&", "&&"))
        if "static" in words:
            behind = "static"
        space = "::".join(scope.name for scope in self.scopes if scope.kind == "namespace" and scope.name)
        self.functions.append((space, owner, returned, head["name"], parameters, behind))


def use(function):
    """A statement that needs the function, in a class that inherits its own."""
    space, owner, returned, name, parameters, behind = function
    scope = space + "::" + (owner + "::" if owner else "")
    if owner and name in (owner.split("::")[-1], "~" + owner.split("::")[-1]):
        if name.startswith("~"):
            return f"need(&destroy<{space}::{owner}>);"
        return f"need(Made<{space}::{owner}, void({parameters})>::function());"
    member = f"{scope}*" if owner and behind != "static" else "*"
    suffix = "" if behind == "static" else behind
    return f"need(static_cast<{returned} ({member})({parameters}) {suffix}>(&{scope}{name}));"


PROGRAM = """// Written by list_public_functions.py.
%s
#include <cstdio>
#include <utility>
#include <vector>

namespace {

std::vector<unsigned char> needed;

template <typename Function>
void need(Function function) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(&function);
  needed.insert(needed.end(), bytes, bytes + sizeof function);
}

template <typename Class>
void destroy(Class* object) {
  object->~Class();
}

template <typename Class, typename Parameters>
struct Made;
template <typename Class, typename... Parameters>
struct Made<Class, void(Parameters...)> {
  static Class* make(Parameters... parameters) { return new Class(static_cast<Parameters&&>(parameters)...); }
  static auto function() { return &make; }
};

}  // namespace

%s

int main() {
%s
  std::printf("%%d functions\\n", %d);
  return needed.empty() ? 1 : 0;
}
"""


def main():
    folder, output = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    headers = sorted(folder.rglob("*.h"))
    scans = [Scan(header.read_text()) for header in headers]
    # Nobody outside can give what no installed header defines.
    unknown = set().union(*(scan.declared for scan in scans)) - set().union(*(scan.defined for scan in scans))
    functions = [
        function for scan in scans for function in scan.functions if not takes_by_value(function[4], unknown)
    ]
    by_owner = {}
    for function in functions:
        by_owner.setdefault(function[:2], []).append(use(function))
    classes, calls = [], []
    for number, ((space, owner), statements) in enumerate(by_owner.items()):
        base = f" : {space}::{owner}" if owner else ""
        body = "\n".join("    " + statement for statement in statements)
        classes.append(f"namespace {space} {{\nstruct Uses{number}{base} {{\n  static void all() {{\n{body}\n  }}\n}};\n}}")
        calls.append(f"  {space}::Uses{number}::all();")
    includes = "\n".join(f"#include <{header.relative_to(folder).as_posix()}>" for header in headers)
    output.write_text(PROGRAM % (includes, "\n".join(classes), "\n".join(calls), len(functions)))
    print(f"{len(functions)} functions of {len(headers)} headers")


if __name__ == "__main__":
    main()
