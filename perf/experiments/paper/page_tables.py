"""The tables of the page with the results: each table_NAME() returns the lines of a Markdown table.

Its argument reads a table of rsackermann_reproduce_paper by name.
"""

from result_tables import bias_per_degree, bound_ratios, known, mean, median, quantile

TITLES = {'paper': '*paper*',
          'paper_1la': '*paper*, 1-LA',
          'paper_3la': '*paper*, 3-LA',
          'paper_global': '*paper*, depth at the global-shutter point',
          'ours': '*ours*',
          'ours_gravity': '*ours*, gravity exact',
          'ours_gyro': '*ours*, yaw rate known to 1 deg/s',
          'ours_1la': '*ours*, 1-LA, gravity exact',
          'ours_3la': '*ours*, 3-LA, gravity exact',
          'ours_4la': '*ours*, 4-LA, gravity exact'}
SOLVERS = {'1la': '1-LA',
           '3la': '3-LA',
           '4la_rolling': '4-LA, cubic, as in the paper',
           '4la_global': '4-LA, cubic, depth at the global-shutter point',
           '4la_exact': '4-LA, exact'}
MAIN = ('paper', 'ours_gravity', 'ours')
IMAGES_IN_PAPER = 'as box plots; no numbers to quote'


def lines_of(header, rows):
    return (['| ' + ' | '.join(header) + ' |', '|' + '---|' * len(header)] +
            ['| ' + ' | '.join(str(cell) for cell in row) + ' |' for row in rows])


def text(value, decimals=2):
    return '%.*f' % (decimals, value)


def table_displacement(load):
    displacement = load('displacement')
    rows = [['reported in the paper', '', '4.72', '', '0.88; 1.24; 1.53', '', '', '0.19; 0.26; 0.32']]
    for name in ('paper_1la', 'paper_3la', 'paper', 'paper_global',
                 'ours_1la', 'ours_3la', 'ours_gravity', 'ours', 'ours_gyro'):
        images = displacement.select(contestant=name)
        raw, left = [row['raw_px'] for row in images], [row['left_px'] for row in images]
        worse = sum(after > before for before, after in zip(raw, left))
        rows.append([TITLES[name], len(images), text(mean(raw)), text(median(raw)), text(mean(left), 3),
                     text(median(left), 3), text(quantile(left, 0.9), 3), text(median(left) / median(raw), 3), worse])
    rows[0].append('')
    header = ['contestant', 'images', 'raw, mean, px', 'raw, median', 'residual, mean, px', 'residual, median',
              'residual, 90 %', 'residual / raw', 'worse than raw']
    return lines_of(header, rows)


def table_patches(load):
    patches = load('patches')
    rows = [['reported in the paper', '', '', '4.72', '0.88; 1.24; 1.53']]
    for name in ('paper_1la', 'paper_3la') + MAIN:
        images = patches.select(contestant=name)
        rows.append([TITLES[name]] +
                    [text(median([row[column] for row in images]), 3) for column in ('raw_px', 'left_px')] +
                    [text(mean([row[column] for row in images]), 3)
                     for column in ('raw_patches_px', 'left_patches_px')])
    return lines_of(['contestant', 'raw, dense truth, median', 'residual, dense truth, median', 'raw, patches, mean',
                     'residual, patches, mean'], rows)


def table_consensus(load):
    motion = load('motion')
    rows = []
    for name in ('paper', 'ours_gravity'):
        images = motion.select(contestant=name, part='4la')
        ratios = [row['wall_ratio'] for row in images]
        rows.append([TITLES[name], text(median([row['inliers'] for row in images]), 0),
                     text(median([row['line_at_infinity_px'] for row in images]), 1),
                     text(median(ratios)), text(quantile(ratios, 0.9))])
    rows.append(['truth', text(median([row['true_inliers'] for row in images]), 0), '0', text(2.5 / 3), text(2.5 / 3)])
    return lines_of(['', 'inliers, median', 'vanishing point, px to the right', 'ratio of the walls, median', '90 %'],
                    rows)


def motion_rows(load, part, quantity, names, **values):
    motion = load('motion')
    rows = []
    for name in names:
        errors = [row['estimated_' + quantity] - row[quantity]
                  for row in motion.select(contestant=name, part=part, **values)]
        sizes = [abs(error) for error in errors]
        rows.append([TITLES[name], len(errors), text(median(errors)), text(median(sizes)), text(quantile(sizes, 0.9))])
    return rows


def motion_table(load, part, quantity, unit, names, **values):
    rows = [['reported in the paper', '', IMAGES_IN_PAPER, '', '']] + motion_rows(load, part, quantity, names, **values)
    return lines_of(['contestant', 'images', 'error, median, ' + unit, 'absolute error, median', '90 %'], rows)


def table_figure5a(load):
    return motion_table(load, '1la', 'yaw_rate', 'deg/s', ('paper_1la', 'ours_1la', 'ours'))


def table_figure5b(load):
    return motion_table(load, '3la', 'speed', 'km/h', ('paper_3la', 'ours_3la', 'ours'))


def table_figure5c(load):
    return motion_table(load, '4la', 'yaw_rate', 'deg/s', ('paper_1la', 'ours_1la'))


def table_figure5d(load):
    return motion_table(load, '4la', 'speed', 'km/h', ('paper_3la', 'ours_3la'))


def table_figure5e(load):
    return motion_table(load, '4la', 'yaw_rate', 'deg/s', MAIN + ('ours_gyro',))


def table_figure5f(load):
    return motion_table(load, '4la', 'speed', 'km/h', MAIN + ('ours_gyro',))


def table_figure5g(load):
    gravity = load('gravity')
    read_outs = gravity.values_of('readout_ms')
    focal_over_height = 816 * 520 / 640 / 360
    rows = [['reported in the paper', 'roll and pitch'] + ['"minimal effect"'] * len(read_outs),
            ['law', 'roll'] + [text(1e3 / (focal_over_height * r)) for r in read_outs]]
    for name in MAIN:
        for kind in ('roll', 'pitch'):
            slopes = [bias_per_degree(gravity.select(contestant=name, kind=kind, readout_ms=r), kind)
                      for r in read_outs]
            rows.append([TITLES[name], kind] + [text(slope) for slope in slopes])
    return lines_of(['yaw rate off by, deg/s for a degree', 'of'] + ['%g ms' % r for r in read_outs], rows)


def table_gravity_left(load):
    gravity = load('gravity')
    read_outs = gravity.values_of('readout_ms')
    rows = [['raw', ''] + [text(gravity.select(readout_ms=r)[0]['raw_px']) for r in read_outs]]
    for name in MAIN:
        for kind in ('roll', 'pitch', 'both'):
            rows.append([TITLES[name], kind] +
                        [text(median([row['left_px']
                                      for row in gravity.select(contestant=name, kind=kind, readout_ms=r)]))
                         for r in read_outs])
    return lines_of(['residual displacement, median, px', 'off'] + ['%g ms' % r for r in read_outs], rows)


def distance_table(load, mistake, column, unit):
    distances = load('distances')
    rows = [['reported in the paper', IMAGES_IN_PAPER, '', '']]
    for name in MAIN:
        less, more = [distances.select(contestant=name, mistake=mistake, error_cm=error) for error in (-10, 10)]
        cells = [less, distances.select(contestant=name, mistake='none'), more]
        rows.append([TITLES[name]] +
                    ['%s (%s)' % (text(median([row[column] for row in cell]), 3),
                                  text(mean([row[column] for row in cell]), 3))
                     for cell in cells])
    return lines_of([unit, '-10 cm', 'exact', '+10 cm'], rows)


def table_figure5h(load):
    return distance_table(load, 'wall', 'speed_error', 'error of the speed, median (mean), km/h')


def table_figure7(load):
    return distance_table(load, 'height', 'left_px', 'residual displacement, median (mean), px')


def table_time(load):
    times = load('time')
    reported = {'paper_1la': '1', 'paper_3la': '3', 'paper': '87'}
    rows = []
    for name in ('paper_1la', 'paper_3la', 'paper', 'paper_global',
                 'ours_1la', 'ours_3la', 'ours_4la', 'ours_gravity', 'ours'):
        images = times.select(contestant=name)
        iterations = median([row['iterations'] for row in images])
        rows.append([TITLES[name], reported.get(name, ''),
                     text(median([row['estimation_ms'] for row in images]), 3),
                     text(quantile([row['estimation_ms'] for row in images], 1), 3),
                     text(median([row['segments'] for row in images]), 0),
                     text(median([row['candidates'] for row in images]), 0),
                     text(iterations, 0) if iterations >= 0 else 'not reported'])
    detection = [row['detection_ms'] for row in times.rows]
    rows.append(['LSD', '', text(median(detection), 2), text(quantile(detection, 1), 2), '', '', ''])
    header = ['contestant', 'reported in the paper, ms', 'here, median, ms', 'here, largest, ms', 'segments',
              'candidates', 'iterations']
    return lines_of(header, rows)


def table_solvers(load):
    solvers, condition, times = load('solvers'), load('solver_condition'), load('solver_time')
    rows = []
    for name, title in SOLVERS.items():
        exact = solvers.select(solver=name, noise_px=0)
        errors = known([row['error'] for row in exact])
        sensitivity = condition.select(solver=name)
        per_pixel = ['%.2f' % median([row[column] for row in sensitivity])
                     if any(row[column] > 0 for row in sensitivity) else ''
                     for column in ('yaw_rate_per_px', 'speed_per_px')]
        failures = [100 * sum(row['solutions'] == 0 for row in group) / len(group)
                    for group in (exact, solvers.select(solver=name, noise_px=0.25),
                                  solvers.select(solver=name, noise_px=1))]
        rows.append([title, text(times.select(solver=name)[0]['nanoseconds'], 0),
                     '%.1e' % median(errors), '%.1e' % quantile(errors, 0.9),
                     '%.2f (%d)' % (mean([row['solutions'] for row in exact]), max(row['solutions'] for row in exact)),
                     ' / '.join(text(f, 1) for f in failures), per_pixel[0], per_pixel[1]])
    header = ['solver', 'ns', 'error, median', '90 %', 'solutions, mean (most)', 'no solution at 0 / 0.25 / 1 px, %',
              'yaw rate, per px', 'speed, per px']
    return lines_of(header, rows)


def table_solver_noise(load):
    solvers = load('solvers')
    noises = solvers.values_of('noise_px')
    rows = [[title] +
            ['%.2g' % median([row['error'] for row in solvers.select(solver=name, noise_px=n)]) for n in noises]
            for name, title in SOLVERS.items()]
    return lines_of(['median relative error at'] + ['%g px' % n for n in noises], rows)


def table_bound(load):
    bound = load('bound')
    rows = []
    for name in ('paper', 'ours_gravity'):
        ratios = [bound_ratios(bound, name, quantity) for quantity in ('yaw_rate', 'speed')]
        rows.append([TITLES[name]] +
                    [cell for r in ratios for cell in (text(median(r)), text(quantile(r, 0.9)), text(max(r)))])
    limits = [median([row[column] for row in bound.rows]) for column in ('yaw_rate_bound', 'speed_bound')]
    rows.append(['the bound itself', text(limits[0]) + ' deg/s', '', '', text(limits[1]) + ' km/h', '', ''])
    return lines_of(['root mean square error over the bound', 'yaw rate, median', '90 %', 'largest',
                     'speed, median', '90 %', 'largest'], rows)


def table_conditions(load):
    conditions = load('conditions')
    rows = []
    for factor in ('segments', 'outliers', 'readout_ms', 'focal_error_percent', 'width_px'):
        for value in sorted(set(row['value'] for row in conditions.select(factor=factor))):
            cells = []
            for name in MAIN:
                cases = conditions.select(contestant=name, factor=factor, value=value)
                cells.append(text(median([row['left_px'] for row in cases])))
                cells.append(text(median([abs(row['yaw_rate_error']) for row in cases]), 1))
            raw = median([row['raw_px'] for row in conditions.select(contestant='paper', factor=factor, value=value)])
            rows.append([factor.replace('_', ' '), '%g' % value, text(raw)] + cells)
    header = ['condition', '', 'raw, px']
    for name in MAIN:
        header += [TITLES[name] + ', residual, px', 'yaw rate, deg/s']
    return lines_of(header, rows)


def table_known(load):
    conditions = load('conditions')
    words = {0: 'nothing', 1: 'speed to 2 km/h', 2: 'yaw rate to 1 deg/s', 3: 'both'}
    rows = []
    for value in sorted(set(row['value'] for row in conditions.select(factor='known'))):
        row = [words[int(value)]]
        for name in ('ours_gravity', 'ours'):
            cases = conditions.select(contestant=name, factor='known', value=value)
            row += [text(median([case['left_px'] for case in cases]), 3),
                    text(median([abs(case['yaw_rate_error']) for case in cases])),
                    text(median([abs(case['speed_error']) for case in cases]))]
        rows.append(row)
    header = ['known']
    for name in ('ours_gravity', 'ours'):
        header += [TITLES[name] + ', residual, px', 'yaw rate, deg/s', 'speed, km/h']
    return lines_of(header, rows)


def table_photos(load):
    try:
        photos = load('photos')
    except FileNotFoundError:
        return ['Made without photographs (`--photos=FOLDER`).']
    rows = []
    for kind in ('photographs', 'drive', 'frames'):
        for name in MAIN:
            images = photos.select(contestant=name, kind=kind)
            if not images:
                continue
            before, after = [row['before'] for row in images], [row['after'] for row in images]
            better = ([a < b for b, a in zip(before, after)] if kind != 'frames' else
                      [a > b for b, a in zip(before, after)])
            worse = ([a > b + 1e-3 for b, a in zip(before, after)] if kind != 'frames' else
                     [a < b - 1e-3 for b, a in zip(before, after)])
            rows.append([kind + (', PSNR, dB' if kind == 'frames' else ', displacement, px'), TITLES[name],
                         len(images), text(median(before)), text(median(after)), text(mean(before)), text(mean(after)),
                         sum(better), sum(worse)])
    return lines_of(['images', 'contestant', 'number', 'before, median', 'after', 'before, mean', 'after', 'better',
                     'worse'], rows)


def table_expectations(load):
    displacement, times, bound = load('displacement'), load('solver_time'), load('bound')
    left = {name: median([row['left_px'] for row in displacement.select(contestant=name)]) for name in MAIN}
    ratio = left['ours_gravity'] / left['paper']
    solver = {name: times.select(solver=name)[0]['nanoseconds'] for name in ('1la', '3la')}
    estimation = {name: 1e3 * median([row['estimation_ms'] for row in load('time').select(contestant=name)])
                  for name in ('paper_1la', 'paper_3la')}
    distance = median(bound_ratios(bound, 'ours_gravity', 'yaw_rate'))
    rows = [['*ours*, gravity exact, has at most 0.1 of the residual of *paper* (medians)',
             text(ratio, 3), ratio <= 0.1],
            ['1-LA and 3-LA in microseconds: the estimation by *paper*, and the solver',
             '%.0f and %.0f µs; %.3f and %.3f µs' % (
                 estimation['paper_1la'], estimation['paper_3la'], solver['1la'] / 1e3, solver['3la'] / 1e3),
             max(estimation.values()) < 1e3],
            ['root mean square error of the yaw rate at most 1.3 of the Cramér–Rao bound in the median, gravity exact',
             text(distance), distance <= 1.3]]
    return lines_of(['expected', 'measured', 'reached'], [row[:2] + ['yes' if row[2] else 'no'] for row in rows])
