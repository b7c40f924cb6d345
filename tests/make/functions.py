#!/usr/bin/env python3
"""functions.py [ROOT] [--list]: prints how many lines core/ and server/ below ROOT have, how many functions, the median
and 90th percentile of their lines from return type to closing brace, the functions with six parameters or more, and the
folders with too many files. --list prints all of these functions, "PARAMETERS FILE:LINE NAME", without it the worst ten.
"""
import os
import re
import sys

FILES_MAX = 45
PARAMETERS_MANY = 6
FOLDERS_OF_FILES = ("core", "server", "clients", "tests")
ALL_FILES_MAY = re.compile(r"tests/scenes|pictures")

# What has no code: comments, texts, and lines of the preprocessor.
BLANK = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:\\\n|[^\n])*', re.S | re.M)
NAME_BEFORE = re.compile(r"([a-z_]\w*|ZR_KERNEL\(\w+\))\s*$")


def without_texts(text):
    """Replaces comments and strings by blanks. Line numbers stay."""
    return BLANK.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def parameters(text):
    """Returns the parameters of "(A, B)"."""
    depth, found = 0, [""]
    for character in text[1:-1]:
        depth += (character == "(") - (character == ")")
        if character == "," and depth == 0:
            found.append("")
        else:
            found[-1] += character
    found = [" ".join(each.split()) for each in found]
    return [] if found in ([""], ["void"]) else found


def statements(code):
    """Yields (start, open, close) of each declaration at file level: `open` is its brace or semicolon, `close` its end."""
    depth = start = opened = 0
    for match in re.finditer(r"[{};]", code):
        opened = match.start() if depth == 0 else opened
        depth += (match.group() == "{") - (match.group() == "}")
        if depth == 0:
            yield start, opened, match.start()
            start = match.end()


def opening(code, end):
    """Returns the place of the parenthesis that the one before `end` closes."""
    depth = 0
    for place in range(end - 1, -1, -1):
        depth += (code[place] == ")") - (code[place] == "(")
        if depth == 0:
            return place
    return 0


def functions_of(path):
    """Yields (parameters, lines, line, name) of each function that a file defines, and of each that it declares, whose
    lines are 0."""
    with open(path, encoding="utf-8") as file:
        code = without_texts(file.read())
    for start, opened, closed in statements(code):
        end = len(code[:opened].rstrip())
        first = opening(code, end) if end > start and code[end - 1] == ")" else start
        name = NAME_BEFORE.search(code, start, first)
        if name:
            begin = len(code[:name.start()]) - len(code[start:name.start()].lstrip())
            lines = code.count("\n", begin, closed) + 1 if code[opened] == "{" else 0
            line = code.count("\n", 0, name.start()) + 1
            yield len(parameters(code[first:end])), lines, line, name.group(1)


def sources(folder):
    for where, _, names in os.walk(folder):
        for name in names:
            if name.endswith((".c", ".h")):
                yield os.path.join(where, name)


def lines_of(folder):
    total = 0
    for path in sources(folder):
        with open(path, "rb") as file:
            total += file.read().count(b"\n")
    return total


def full_folders():
    for root in FOLDERS_OF_FILES:
        for where, _, names in os.walk(root):
            if len(names) > FILES_MAX and not ALL_FILES_MAY.search(where) and "__pycache__" not in where:
                yield where, len(names)


def main():
    arguments = [each for each in sys.argv[1:] if each != "--list"]
    os.chdir(arguments[0] if arguments else ".")
    found = [(*each, path) for folder in ("core", "server") for path in sources(folder) for each in functions_of(path)]
    sizes = sorted(lines for _, lines, _, _, _ in found if lines)
    many = sorted((each for each in found if each[0] >= PARAMETERS_MANY), key=lambda each: (-each[0], each[4], each[2]))
    defined = [each for each in many if each[1]]
    print(f"lines: core {lines_of('core')}, server {lines_of('server')}")
    print(f"functions: {len(sizes)}, median {sizes[len(sizes) // 2]} lines, "
          f"90th percentile {sizes[len(sizes) * 9 // 10]}, longest {sizes[-1]}")
    print(f"functions with {PARAMETERS_MANY} parameters or more: {len(defined)}, "
          f"and {len(many) - len(defined)} declarations of them")
    for count, _, line, name, path in defined if "--list" in sys.argv else defined[:10]:
        print(f"  {count} {path}:{line} {name}")
    for where, files in full_folders():
        print(f"folder with more than {FILES_MAX} files: {where} {files}")


main()
