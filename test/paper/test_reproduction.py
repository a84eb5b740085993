#!/usr/bin/env python3
"""Runs perf/experiments/reproduce_paper.sh --quick and looks at what it has made.

usage: test_reproduction.py ROOT BUILD
"""

import csv
import os
import re
import statistics
import subprocess
import sys
import tempfile

root, build = sys.argv[1:]
script = os.path.join(root, 'perf', 'experiments', 'reproduce_paper.sh')
program = os.path.join(build, 'perf', 'experiments', 'paper', 'rsackermann_reproduce_paper')
problems = []


def check(condition, message):
    if not condition:
        problems.append(message)


def read(path):
    with open(path, encoding='utf-8') as file:
        return file.read()


def times_in(folder):
    return {name: os.stat(os.path.join(folder, name)).st_mtime_ns
            for name in os.listdir(folder) if name.endswith('.csv')}


def check_displacement(path):
    rows = list(csv.DictReader(read(path).splitlines()))
    check(read(path).splitlines()[0] == 'contestant,image,speed_kmh,yaw_rate_deg_s,raw_px,left_px',
          'displacement.csv has other columns')
    left = {}
    raw = {}
    for row in rows:
        left.setdefault(row['contestant'], []).append(float(row['left_px']))
        raw.setdefault(row['image'], set()).add(row['raw_px'])
    check({'paper', 'ours', 'ours_gravity'} <= set(left), 'displacement.csv lacks a contestant')
    check(len(set(len(values) for values in left.values())) == 1, 'displacement.csv lacks images of a contestant')
    check(all(len(values) == 1 for values in raw.values()), 'the displacement of a raw image depends on the contestant')
    before = statistics.median(float(value) for values in raw.values() for value in values)
    check(statistics.median(left['paper']) < 0.6 * before, "the paper's method corrects too little")
    check(statistics.median(left['ours_gravity']) < 0.1 * before, 'the library corrects too little')


def check_page(page):
    text = read(page)
    images = re.findall(r'!\[[^]]*\]\(([^)]+)\)', text)
    check(images, 'the page has no images')
    for image in images:
        path = os.path.join(os.path.dirname(page), image)
        check(os.path.exists(path) and os.path.getsize(path) > 0, 'the image %s is missing' % image)
    check('<!-- table' not in text, 'a table of the page is missing')
    check(not re.search(r'\|[^|\n]*\bnan\b', text), 'the page has values that are not numbers')


with tempfile.TemporaryDirectory() as folder:
    tables = os.path.join(folder, 'tables')
    subprocess.run([script, build, folder, '--quick'], check=True)
    check_displacement(os.path.join(tables, 'displacement.csv'))
    check_page(os.path.join(folder, 'paper.md'))

    # Complete tables stay, a missing one is made again.
    os.remove(os.path.join(tables, 'bound.csv'))
    before = times_in(tables)
    subprocess.run([script, build, folder, '--quick'], check=True)
    after = times_in(tables)
    check('bound.csv' in after, "a missing table wasn't made again")
    check(all(after[name] == before[name] for name in before), 'a complete table was made again')
    check(subprocess.run([script, build, folder], stderr=subprocess.DEVNULL).returncode == 1,
          'tables of other options were used')

    # The same for a seed, whatever the number of threads.
    again = os.path.join(folder, 'again')
    os.mkdir(again)
    subprocess.run([program, 'motion', '--quick', '--threads=1', '--output=' + again], check=True)
    for name in ('motion.csv', 'displacement.csv'):
        check(read(os.path.join(tables, name)) == read(os.path.join(again, name)), 'two runs differ in %s' % name)

for problem in problems:
    print(problem)
sys.exit(1 if problems else 0)
