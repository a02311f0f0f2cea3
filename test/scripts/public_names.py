"""The names that a C++ header of this package declares for its users: types, functions, constants, public members.

A scanner for headers as they are written here, not for all of C++: no macros, no declarations inside of others but
classes in namespaces and in classes.
"""
import re

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*$", re.MULTILINE)
_TEXT = re.compile(r'"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)\'')
_TYPE = re.compile(r"\b(class|struct|union)\s+(?:\[\[\w+\]\]\s*)?(\w+)(?:\s+final)?\s*(?::[^:].*)?$", re.DOTALL)
_ENUM = re.compile(r"\benum(?:\s+(?:class|struct))?\s+(\w+)")
_NAMESPACE = re.compile(r"^(?:inline\s+)?namespace(?:\s+([\w:]+))?$")


class _Scope:
    def __init__(self, kind, name, is_public):
        self.kind, self.name, self.is_public = kind, name, is_public


def public_names(text):
    """Pairs of the enclosing types and a name, in the order of the header."""
    code = _TEXT.sub("_", _DIRECTIVE.sub("", _COMMENT.sub(" ", text)))
    code = re.sub(r"\balignas\([^()]*\)|\bEIGEN_MAKE_ALIGNED_OPERATOR_NEW\b", "", code)
    code = re.sub(r"\b(public|protected|private)\s*:(?!:)", r";@\1;", code)
    scopes, statement, skipped, found = [], "", 0, []

    def is_visible():
        return all(scope.is_public for scope in scopes)

    def types():
        return [scope.name for scope in scopes if scope.kind in ("type", "enum")]

    def keep(names):
        if is_visible():
            found.extend((types(), name) for name in names)

    ends_statement = False
    for part in re.findall(r"[{};]|[^{};]+", code):
        if skipped:
            skipped += {"{": 1, "}": -1}.get(part, 0)
            if not skipped and ends_statement:
                statement = ""
            continue
        if part == "{":
            head = statement.strip()
            without_template = _without_angles(re.sub(r"^template\s*", "", head))
            namespace = _NAMESPACE.match(head)
            enumeration = _ENUM.search(head)
            kind = _TYPE.search(without_template) if "(" not in without_template else None
            if namespace:
                scopes.append(_Scope("namespace", "", "detail" not in (namespace.group(1) or "anonymous detail")))
                statement = ""
            elif enumeration and "(" not in head:
                keep([enumeration.group(1)])
                scopes.append(_Scope("enum", enumeration.group(1), True))
                statement = ""
            elif kind:
                keep([kind.group(2)])
                scopes.append(_Scope("type", kind.group(2), True))
                scopes.append(_Scope("access", "", kind.group(1) != "class"))
                statement = ""
            else:
                ends_statement = "(" in without_template and "=" not in re.sub(r"operator\s*\S+|\([^()]*\)", "", without_template)
                if ends_statement:
                    keep(_declared(head))
                skipped = 1
        elif part == "}":
            scope = scopes.pop()
            if scope.kind == "enum":
                scopes.append(scope)
                keep(re.findall(r"(?:^|,)\s*(\w+)", statement))
                scopes.pop()
            elif scope.kind == "access":
                scopes.pop()
            statement = ""
        elif part == ";" and statement.strip().startswith("@"):
            scopes[-1].is_public = statement.strip() == "@public"
            statement = ""
        elif part == ";":
            keep(_declared(statement.strip()))
            statement = ""
        else:
            statement += part
    return found


def _without_angles(text):
    text = re.sub(r"operator\s*[<>]+=?", lambda name: name.group(0).replace("<", "\1").replace(">", "\2"), text)
    while True:
        shorter = re.sub(r"<[^<>]*>", "", text)
        if shorter == text:
            return text
        text = shorter


def _declared(statement):
    """The names that one statement declares."""
    if not statement or re.match(r"(friend|static_assert|template\s*<>|using namespace)\b", statement):
        return []
    alias = re.match(r"(?:template\s*<.*?>\s*)?using\s+(\w+)\s*=", statement, re.DOTALL)
    if alias:
        return [alias.group(1)]
    plain = _without_angles(re.sub(r"^template\s*", "", statement)).strip()
    if not plain or re.match(r"(class|struct|enum)\s+[^=()]*$", plain):
        return []
    pointer = re.search(r"\(\s*\*\s*(\w+)\s*\)\s*\(", plain)
    if pointer:
        return [pointer.group(1)]
    function = re.match(r"[^=(]*?(operator\s*(?:\(\)|[^\s\w(]+|\w+)|~?\w+)\s*\(", plain, re.DOTALL)
    if function:
        return [re.sub(r"\s+", "", function.group(1)).replace("\1", "<").replace("\2", ">")]
    plain = re.sub(r"\([^()]*\)", "", plain)
    names = [re.search(r"(\w+)\s*(?:\[.*\])?\s*(?:=.*)?$", piece.strip(), re.DOTALL) for piece in plain.split(",")]
    return [name.group(1) for name in names if name]
