#!/usr/bin/env python3
"""Makes a file for each box, line or histogram that plots.gp draws.

usage: plot_data.py TABLES DATA
"""

import collections
import math
import os
import sys

from result_tables import Table, bias_per_degree, bound_ratios, mean, median, quantile

MAIN = ('paper', 'ours_gravity', 'ours')


def write_lines(folder, name, lines):
    with open(os.path.join(folder, name + '.dat'), 'w', encoding='utf-8') as file:
        for line in lines:
            file.write(' '.join('%.6g' % value for value in line) + '\n')


def box(x, values):
    """Position, 5 %, 25 %, 50 %, 75 % and 95 % quantiles, mean."""
    return [x] + [quantile(values, f) for f in (0.05, 0.25, 0.5, 0.75, 0.95)] + [mean(values)]


def write_boxes(folder, name, rows, key, value):
    groups = collections.OrderedDict()
    for row in rows:
        groups.setdefault(row[key], []).append(value(row))
    write_lines(folder, name, [box(x, groups[x]) for x in sorted(groups)])


def estimated(quantity):
    """The estimate, less what noise has added to the motion that was set."""
    return lambda row: row['estimated_' + quantity] - row[quantity] + row['set_' + quantity]


def plot_motion(tables, data):
    motion = Table(tables, 'motion')
    for name in ('paper_1la', 'ours_1la'):
        write_boxes(data, 'figure5a_' + name, motion.select(contestant=name, part='1la'), 'set_yaw_rate',
                    estimated('yaw_rate'))
    for name in ('paper_3la', 'ours_3la'):
        write_boxes(data, 'figure5b_' + name, motion.select(contestant=name, part='3la'), 'set_speed',
                    estimated('speed'))
    both = motion.select(part='4la')
    for speed in sorted(set(row['set_speed'] for row in both)):
        write_boxes(data, 'figure5c_%d' % speed, motion.select(contestant='paper_1la', part='4la', set_speed=speed),
                    'set_yaw_rate', estimated('yaw_rate'))
        for name in MAIN:
            write_boxes(data, 'figure5e_%d_%s' % (speed, name),
                        motion.select(contestant=name, part='4la', set_speed=speed),
                        'set_yaw_rate', estimated('yaw_rate'))
    for yaw_rate in sorted(set(row['set_yaw_rate'] for row in both)):
        write_boxes(data, 'figure5d_%d' % yaw_rate,
                    motion.select(contestant='paper_3la', part='4la', set_yaw_rate=yaw_rate),
                    'set_speed', estimated('speed'))
    for name in MAIN:
        write_boxes(data, 'figure5f_' + name, motion.select(contestant=name, part='4la'), 'set_speed',
                    estimated('speed'))
    displacement = Table(tables, 'displacement')
    lines = [box(0, [row['raw_px'] for row in displacement.select(contestant='paper')])]
    for i, name in enumerate(('paper_1la', 'paper_3la') + MAIN + ('ours_gyro',)):
        lines.append(box(i + 1, [row['left_px'] for row in displacement.select(contestant=name)]))
    write_lines(data, 'figure6', lines)


def plot_knowledge(tables, data):
    gravity = Table(tables, 'gravity')
    distances = Table(tables, 'distances')
    for name in MAIN:
        for kind in ('roll', 'pitch'):
            write_lines(data, 'figure5g_%s_%s' % (kind, name),
                        [[read_out, abs(bias_per_degree(
                            gravity.select(contestant=name, kind=kind, readout_ms=read_out), kind))]
                         for read_out in gravity.values_of('readout_ms')])
        same = distances.select(contestant=name, mistake='none')
        write_boxes(data, 'figure5h_' + name, same + distances.select(contestant=name, mistake='wall'), 'error_cm',
                    lambda row: row['speed_error'])
        write_boxes(data, 'figure7_' + name, same + distances.select(contestant=name, mistake='height'), 'error_cm',
                    lambda row: row['left_px'])


def plot_solvers(tables, data):
    solvers = Table(tables, 'solvers')
    for name in solvers.values_of('solver'):
        rows = solvers.select(solver=name)
        write_lines(data, 'solver_noise_' + name,
                    [[noise, median([row['error'] for row in rows if row['noise_px'] == noise])]
                     for noise in solvers.values_of('noise_px')])
        logs = [math.log10(max(row['error'], 1e-16)) for row in rows
                if row['noise_px'] == 0 and not math.isnan(row['error'])]
        bins = collections.Counter(math.floor(2 * value) / 2 for value in logs)
        write_lines(data, 'solver_histogram_' + name, [[b + 0.25, 100 * bins[b] / len(logs)] for b in sorted(bins)])


def plot_conditions(tables, data):
    conditions = Table(tables, 'conditions')
    bound = Table(tables, 'bound')
    for name in MAIN:
        for factor in conditions.values_of('factor'):
            rows = conditions.select(contestant=name, factor=factor)
            write_lines(data, 'condition_%s_%s' % (factor, name),
                        [[v, median([row['left_px'] for row in rows if row['value'] == v])]
                         for v in sorted(set(row['value'] for row in rows))])
        for quantity in ('yaw_rate', 'speed'):
            ratios = sorted(bound_ratios(bound, name, quantity))
            write_lines(data, 'bound_%s_%s' % (quantity, name),
                        [[ratio, (i + 1) / len(ratios)] for i, ratio in enumerate(ratios)])


def main(tables, data):
    plot_motion(tables, data)
    plot_knowledge(tables, data)
    plot_solvers(tables, data)
    plot_conditions(tables, data)


if __name__ == '__main__':
    main(*sys.argv[1:])
