#!/usr/bin/env python3
"""Makes the page with the results: the template with the tables in the place of its lines <!-- table: NAME -->.

usage: make_page.py TABLES TEMPLATE PAGE
"""

import sys

import page_tables
from result_tables import Table

BEGIN, END = '<!-- table: ', ' -->'


def main(tables, template, page):
    made = []
    with open(template, encoding='utf-8') as file:
        for line in file.read().split('\n'):
            if line.startswith(BEGIN) and line.endswith(END):
                make = getattr(page_tables, 'table_' + line[len(BEGIN):-len(END)])
                made += make(lambda name: Table(tables, name))
            else:
                made.append(line)
    with open(page, 'w', encoding='utf-8') as file:
        file.write('\n'.join(made))


if __name__ == '__main__':
    main(*sys.argv[1:])
