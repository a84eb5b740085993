#!/usr/bin/env python3
"""Runs the recipes of doc/many_images.md with two shards in two processes, and the inputs in the opposite order, and
compares with a run of one process in the usual order.

The Slurm recipe runs as its array would: with the variables that Slurm sets, once for each task.

usage: check_shards.py ROOT RSACKERMANN_CORRECT RSACKERMANN_SIMULATE
"""

import json
import os
import re
import subprocess
import sys
import tempfile

IMAGES = 5


def recipe(root, name):
    with open(os.path.join(root, 'doc', 'many_images.md'), encoding='utf-8') as file:
        return re.search(r'<!-- tested: %s -->\n```sh\n(.*?)```' % name, file.read(), re.S).group(1)


def render(simulate, folder):
    os.mkdir(os.path.join(folder, 'frames'))
    for seed in range(IMAGES):
        street = os.path.join(folder, 'street%d' % seed)
        subprocess.run([simulate, '--output=' + street, '--seed=%d' % seed, '--size=320x190', '--focal=400'],
                       check=True)
        os.rename(os.path.join(street, 'rolling.png'), os.path.join(folder, 'frames', 'frame%d.png' % seed))
        os.rename(os.path.join(street, 'camera.yml'), os.path.join(folder, 'camera.yml'))


def outcome(folder):
    """The corrected images and the lines of the reports, without the times that they took."""
    images = {}
    for name in os.listdir(os.path.join(folder, 'corrected')):
        with open(os.path.join(folder, 'corrected', name), 'rb') as file:
            images[name] = file.read()
    with open(os.path.join(folder, 'report.jsonl'), encoding='utf-8') as file:
        lines = [{k: v for k, v in json.loads(line).items() if not k.startswith('ms_')} for line in file]
    return images, sorted(lines, key=lambda line: line['input'])


def run(folder, work, command, environment):
    """Runs a script in a folder of its own with the same inputs."""
    os.mkdir(work)
    for name in ('frames', 'camera.yml'):
        os.symlink(os.path.join(folder, name), os.path.join(work, name))
    for variables in environment:
        subprocess.run(['bash', '-ec', command], check=True, cwd=work, env=dict(os.environ, **variables))
    if not os.path.exists(os.path.join(work, 'report.jsonl')):
        subprocess.run('cat report.*.jsonl >report.jsonl', shell=True, check=True, cwd=work)
    return outcome(work)


def main(root, correct, simulate):
    os.environ['PATH'] = os.path.dirname(os.path.abspath(correct)) + os.pathsep + os.environ['PATH']
    with tempfile.TemporaryDirectory() as folder:
        render(simulate, folder)
        whole = run(folder, os.path.join(folder, 'whole'),
                    'rsackermann_correct frames --camera=camera.yml --output=corrected --report=report.jsonl', [{}])
        backwards = run(folder, os.path.join(folder, 'backwards'),
                        'rsackermann_correct $(ls -r frames/*) --camera=camera.yml --output=corrected '
                        '--report=report.jsonl', [{}])
        parallel = run(folder, os.path.join(folder, 'parallel'), recipe(root, 'parallel'), [{}])
        tasks = [{'SLURM_ARRAY_TASK_ID': str(i + 1), 'SLURM_ARRAY_TASK_COUNT': '2'} for i in range(2)]
        slurm = run(folder, os.path.join(folder, 'slurm'), recipe(root, 'slurm'), tasks)
    problems = []
    if len(whole[0]) != IMAGES or len(whole[1]) != IMAGES:
        problems.append('%d images, %d lines; %d are expected' % (len(whole[0]), len(whole[1]), IMAGES))
    for name, result in (('backwards', backwards), ('parallel', parallel), ('slurm', slurm)):
        if result[0] != whole[0]:
            problems.append('%s: the images differ from those without shards in the usual order' % name)
        if result[1] != whole[1]:
            problems.append('%s: the reports differ from that without shards in the usual order' % name)
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
