"""The tables of rsackermann_reproduce_paper and the statistics that plots and page have in common."""

import csv
import itertools
import math
import os


def parse(text):
    try:
        return float(text)
    except ValueError:
        return text


class Table:
    """Rows of a file of comma-separated values as dictionaries."""

    def __init__(self, folder, name):
        with open(os.path.join(folder, name + '.csv'), encoding='utf-8') as file:
            self.rows = [dict((key, parse(value)) for key, value in row.items()) for row in csv.DictReader(file)]

    def select(self, **values):
        return [row for row in self.rows if all(row[key] == value for key, value in values.items())]

    def values_of(self, column):
        return sorted(set(row[column] for row in self.rows))


def known(values):
    return [v for v in values if not math.isnan(v)]


def quantile(values, fraction):
    ordered = sorted(known(values))
    if not ordered:
        return math.nan
    at = fraction * (len(ordered) - 1)
    low = int(at)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (at - low) * (ordered[high] - ordered[low])


def median(values):
    return quantile(values, 0.5)


def mean(values):
    values = known(values)
    return sum(values) / len(values) if values else math.nan


def root_mean_square(values):
    return math.sqrt(mean([v * v for v in values]))


def bias_per_degree(rows, kind):
    """Slope of the yaw rate's error over the error of roll or pitch: the median over all pairs of draws
    (Theil and Sen)."""
    points = [(row[kind + '_deg'], row['yaw_rate_error']) for row in rows]
    return median([(b[1] - a[1]) / (b[0] - a[0]) for a, b in itertools.combinations(points, 2)])


def bound_ratios(bound, contestant, quantity):
    """Root mean square errors over the Cramer-Rao bound, one for each motion."""
    ratios = []
    for speed in bound.values_of('speed'):
        for yaw_rate in bound.values_of('yaw_rate'):
            rows = bound.select(contestant=contestant, speed=speed, yaw_rate=yaw_rate)
            ratios.append(root_mean_square([row[quantity + '_error'] for row in rows]) / rows[0][quantity + '_bound'])
    return ratios
