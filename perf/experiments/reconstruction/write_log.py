#!/usr/bin/env python3
"""Prints the log that a car could write on a drive of rsackermann_simulate, for rsackermann_correct: times, and the named
values in whole km/h or deg/s.

usage: write_log.py TRUTH speed_kmh|yaw_rate_deg_s...
"""

import json
import sys

KEYS = {'speed_kmh': 'speed_km_h', 'yaw_rate_deg_s': 'yaw_rate_deg_s'}


def main(truth, *columns):
    print(','.join(('file', 'time_s') + columns))
    with open(truth, encoding='utf-8') as file:
        for line in file:
            frame = json.loads(line)
            values = ['%d' % round(frame[KEYS[column]]) for column in columns]
            print(','.join([frame['file'], '%.9f' % frame['time_s']] + values))


if __name__ == '__main__':
    main(*sys.argv[1:])
