#!/usr/bin/env python3
"""Makes the points of the tutorial on lidars: a cloud and a box in a rendered street, and what became of them.

usage: lidar_points.py FOLDER           writes cloud.csv: points and a car's box in the frame of the camera, the columns
                                        u0 and v0 where a global shutter would see them
       lidar_points.py FOLDER --errors  compares places.csv, which rsackermann_export made of it, with the true motion
FOLDER is one of rsackermann_simulate with --depth.
"""

import csv
import json
import os
import sys

import cv2
import numpy

STEP = 4         # pixels between two points of a row
ROWS = 10        # pixels between two rows
FARTHEST = 60.   # metres
NEAR = 6.5       # metres to the left of the car's way: trees and parked cars are nearer than houses
PARKED = 5.2     # parked cars are nearer than trees
CAR_WIDTH = 1.7  # metres; one side is seen
ON_EDGE = 25     # points of an edge of the box


def read(folder, name):
    with open(os.path.join(folder, name), encoding='utf-8') as file:
        return json.load(file)


def make_cloud(folder):
    truth = read(folder, 'truth.json')
    depth = cv2.imread(os.path.join(folder, 'global_depth.png'), cv2.IMREAD_UNCHANGED) / 256.
    v, u = [a.ravel() for a in numpy.mgrid[ROWS // 2:truth['height']:ROWS, 1:truth['width']:STEP]]
    z = depth[v, u]
    seen = (z > 0) & (z < FARTHEST)
    u, v, z = u[seen], v[seen], z[seen]
    points = numpy.stack([(u - truth['cx']) * z / truth['fx'], (v - truth['cy']) * z / truth['fy'], z], axis=1)

    # To the right of the car's way, downwards and along it.
    heading = numpy.radians(truth['heading_deg'])
    street = numpy.array([[numpy.cos(heading), 0, -numpy.sin(heading)], [0, 1, 0],
                          [numpy.sin(heading), 0, numpy.cos(heading)]])
    places = points @ street.T
    is_near = (places[:, 0] > -NEAR) & (places[:, 1] < truth['height_m'] - 0.1)
    car = places[is_near & (places[:, 0] > -PARKED)]
    corner = numpy.stack([car.min(axis=0), car.max(axis=0)])
    corner[0, 0] = corner[1, 0] - CAR_WIDTH
    corner[1, 1] = truth['height_m']
    edges = []
    for axis in range(3):
        for a in (0, 1):
            for b in (0, 1):
                edge = numpy.empty((ON_EDGE, 3))
                edge[:, axis] = numpy.linspace(corner[0, axis], corner[1, axis], ON_EDGE)
                edge[:, (axis + 1) % 3] = corner[a, (axis + 1) % 3]
                edge[:, (axis + 2) % 3] = corner[b, (axis + 2) % 3]
                edges.append(edge @ street)

    with open(os.path.join(folder, 'cloud.csv'), 'w', encoding='utf-8') as file:
        file.write('x,y,z,kind,u0,v0\n')

        def write(point, kind):
            file.write('%.4f,%.4f,%.4f,%d,%.3f,%.3f\n' % (
                *point, kind, truth['cx'] + truth['fx'] * point[0] / point[2],
                truth['cy'] + truth['fy'] * point[1] / point[2]))
        for point, near in zip(points, is_near):
            write(point, int(near))
        for k, edge in enumerate(edges):
            for point in edge:
                write(point, 2 + k)


def true_place(point, truth):
    """Where the row of its instant sees a point, by the true motion."""
    heading, rate = numpy.radians([truth['heading_deg'], truth['yaw_rate_deg_s']])
    speed, row, place = truth['speed_km_h'] / 3.6, truth['reference'], None
    for _ in range(100):
        time = (row - truth['reference']) * truth['line_delay_s']
        angle = rate * time
        way = speed * time * numpy.sinc(angle / 2 / numpy.pi)
        x, y, z = point - way * numpy.array([numpy.sin(heading + angle / 2), 0, numpy.cos(heading + angle / 2)])
        c, s = numpy.cos(angle), numpy.sin(angle)
        x, z = c * x - s * z, s * x + c * z
        place = numpy.array([truth['cx'] + truth['fx'] * x / z, truth['cy'] + truth['fy'] * y / z])
        if abs(place[1] - row) < 1e-9:
            break
        row = place[1]
    return place


def compare(folder):
    truth = read(folder, 'truth.json')
    errors = {'as a global shutter': [], 'by the time of the row': []}
    with open(os.path.join(folder, 'places.csv'), encoding='utf-8') as file:
        for row in csv.DictReader(file):
            if row['u'] and int(row['kind']) < 2:
                place = true_place(numpy.array([float(row[name]) for name in 'xyz']), truth)
                for name, columns in zip(errors, (('u0', 'v0'), ('u', 'v'))):
                    errors[name].append(numpy.hypot(*(float(row[column]) - place[k] for k, column in enumerate(columns))))
    for name, values in errors.items():
        print('%s: %d points, error median %.2f, 90 %% %.2f, largest %.2f px' % (
            name, len(values), *numpy.percentile(values, [50, 90, 100])))


if __name__ == '__main__':
    if sys.argv[2:] == ['--errors']:
        compare(sys.argv[1])
    else:
        make_cloud(sys.argv[1])
