#!/usr/bin/env python3
"""Copies the sources and has each constant of the estimation ask the environment for a factor.

Prints a line for each: file, name, value. Named constants count, and literals that functions give a name.
With RSACKERMANN_ABLATE=NAME=FACTOR the constant NAME is multiplied by FACTOR.

usage: instrument_constants.py SOURCES COPY
"""

import pathlib
import re
import shutil
import sys

ROOMS = ('motion', 'features', 'factors', 'optim', 'single', 'sequence', 'calibration')
HELPER = r'''
#ifdef __cplusplus
#ifndef RSACKERMANN_ABLATED
#define RSACKERMANN_ABLATED
#include <cmath>
#include <cstdlib>
#include <cstring>
// The value, or FACTOR times it if RSACKERMANN_ABLATE is NAME=FACTOR; whole numbers stay at least 1.
template <class T> inline T ablated(const char* name, T value)
{
    static const char* const asked = std::getenv("RSACKERMANN_ABLATE");
    const std::size_t length = std::strlen(name);
    if (!asked || std::strncmp(asked, name, length) != 0 || asked[length] != '=')
        return value;
    const double changed = double(value) * std::atof(asked + length + 1);
    return T(0.5) != 0 ? T(changed) : T(changed < 1 ? 1 : std::floor(changed + 0.5));
}
#endif
#endif
'''
DECLARATION = re.compile(r'^(?P<indent>\s*)(?P<head>(?:static )?const (?:double|int|size_t)) (?P<list>[^;(){}]*=[^;]*);', re.M)
# Needed while the compiler runs; steps that shrink would never end.
FIXED = {'ALONG', 'MIN_DETECTOR_SIZE', 'STEP_GROWTH'}


def split(text):
    """The parts between commas that are not in brackets."""
    parts, depth, start = [], 0, 0
    for i, character in enumerate(text):
        depth += {'(': 1, '{': 1, '[': 1, ')': -1, '}': -1, ']': -1}.get(character, 0)
        if character == ',' and depth == 0:
            parts.append(text[start:i])
            start = i + 1
    return parts + [text[start:]]


def is_number(expression):
    """Whether an expression has numbers and constants alone."""
    left = re.sub(r'CV_PI|\b[A-Z][A-Z_]+\b|std::sqrt|[0-9.]+(?:e-?[0-9]+)?|[-+*/(). ]', '', expression)
    return re.search(r'\d', expression) and left.strip() == ''


def instrument(text, file, found):
    """The text with its constants replaced; appends them to found."""
    def replace(match):
        entries = []
        for entry in split(match.group('list')):
            name, equals, value = entry.partition('=')
            name, value = name.strip(), ' '.join(value.split())
            bare = re.sub(r'\[.*\]', '', name)
            label = '%s:%s' % (pathlib.Path(file).stem, bare)
            elements = split(value[1:-1]) if value.startswith('{') else [value]
            # Of functions: a flag, or mathematics.
            trivial = not bare.isupper() and (value in ('0', '1') or 'CV_PI' in value or 'sqrt' in value)
            if not equals or bare in FIXED or trivial or not all(is_number(e) for e in elements):
                entries.append(entry)
                continue
            found.append((file, label, value))
            kind = match.group('head').split()[-1]
            asked = ['ablated<%s>("%s", %s)' % (kind, label, e.strip()) for e in elements]
            entries.append(' %s = %s' % (name, '{%s}' % ', '.join(asked) if value.startswith('{') else asked[0]))
        return '%s%s %s;' % (match.group('indent'), match.group('head'), ','.join(entries).strip())
    return DECLARATION.sub(replace, text)


def main():
    """Copies, replaces and prints."""
    root, copy = map(pathlib.Path, sys.argv[1:])
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(root, copy, ignore=shutil.ignore_patterns('build', 'build-*', '.git', '__pycache__'))
    (copy / 'ablated.hpp').write_text(HELPER)
    sources = copy / 'modules' / 'rsackermann' / 'src'
    for room in ROOMS:
        for path in sorted((sources / room).glob('*.[ch]pp')):
            found, file = [], str(path.relative_to(sources))
            path.write_text(instrument(path.read_text(), file, found))
            for entry in found:
                print(*(part.replace(' ', '') for part in entry))


if __name__ == '__main__':
    main()
