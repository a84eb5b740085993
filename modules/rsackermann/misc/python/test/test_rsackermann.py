#!/usr/bin/env python
# This file is part of OpenCV project.
# It is subject to the license terms in the LICENSE file found in the top-level directory
# of this distribution and at http://opencv.org/license.html.

import copy
import math
import os
import pickle
import sys
import tempfile
import unittest

import cv2 as cv
import numpy as np

from tests_common import NewOpenCVTests

SIZE = (640, 380)
FOCAL = 816.0
LINE_DELAY = 0.4 / 30 / SIZE[1]  # 30 frames a second, 40 % of it to read the rows
LEFT_WALL, RIGHT_WALL = 2.5, 3.0  # metres
YAW_RATE = math.radians(15)
SPEED = 15.0  # metres a second
HAS_CORRECTOR = hasattr(cv.rsackermann, 'RollingShutterCorrector')
needs_corrector = unittest.skipUnless(HAS_CORRECTOR, 'built with RSACKERMANN_CORE_ONLY')


def make_camera():
    camera = cv.rsackermann.RollingShutterCamera.fromFocal(SIZE, FOCAL)
    camera.lineDelay = LINE_DELAY
    camera.height = 1.2
    return camera


def make_motion(camera):
    metric = cv.rsackermann.MetricMotion()
    metric.yawRate = YAW_RATE
    metric.speed = SPEED
    metric.leftDistance = LEFT_WALL
    metric.rightDistance = RIGHT_WALL
    return cv.rsackermann.AckermannMotion.fromMetric(camera, metric)


def project(camera, point):
    """The raw pixel of a point in metres in the frame at the reference row, by bisection on the row."""
    def row_error(row):
        seconds = (row - camera.referenceRow) * LINE_DELAY
        yaw = YAW_RATE * seconds
        length = SPEED * seconds * np.sinc(yaw / 2 / np.pi)
        x = point[0] - length * math.sin(yaw / 2)
        z = point[2] - length * math.cos(yaw / 2)
        x, z = math.cos(yaw) * x - math.sin(yaw) * z, math.sin(yaw) * x + math.cos(yaw) * z
        column = (SIZE[0] - 1) / 2.0 + FOCAL * x / z
        return (SIZE[1] - 1) / 2.0 + FOCAL * point[1] / z - row, column

    low, high = -100.0, SIZE[1] + 100.0
    for _ in range(60):
        middle = (low + high) / 2
        if row_error(middle)[0] > 0:
            low = middle
        else:
            high = middle
    return row_error(middle)[1], middle


def wall_segments(camera):
    """Images of vertical lines on both walls."""
    segments = []
    for z in np.linspace(8, 28, 21):
        for x in (-LEFT_WALL, RIGHT_WALL):
            half = 0.21 * z  # of the visible height
            segments.append(project(camera, (x, -half, z)) + project(camera, (x, 0.8 * half, z)))
    segments = np.array(segments, np.float32)
    inside = (segments[:, 0::2] > 0).all(axis=1) & (segments[:, 0::2] < SIZE[0] - 1).all(axis=1)
    return segments[inside]


class rsackermann_test(NewOpenCVTests):

    def test_camera(self):
        K = np.array([[816, 0, 320], [0, 810, 190], [0, 0, 1]], np.float64)
        camera = cv.rsackermann.RollingShutterCamera(SIZE, K, [0.1, -0.05, 0, 0])
        np.testing.assert_array_equal(camera.cameraMatrix, K)
        self.assertEqual(list(camera.distCoeffs), [0.1, -0.05, 0, 0])
        self.assertEqual(camera.scanDirection, cv.rsackermann.SCAN_TOP_TO_BOTTOM)
        self.assertAlmostEqual(camera.rowTime((5, camera.referenceRow + 81)), 0.1)

        camera.setRollPitch(0.1, -0.2)
        gravity = np.array([math.sin(0.1), math.cos(0.1) * math.cos(-0.2), math.sin(-0.2)])
        np.testing.assert_allclose(camera.gravity(), gravity / np.linalg.norm(gravity), atol=1e-12)

        camera.lineDelay = -1
        with self.assertRaisesRegex(cv.error, 'lineDelay'):
            camera.check()

    def test_camera_from_calibrations(self):
        """Coefficients in the shapes that cv2.calibrateCamera and cv2.fisheye.calibrate return, found with them."""
        K = np.array([[816, 0, 320], [0, 810, 190], [0, 0, 1]], np.float64)
        board = np.array([[x, y, 0] for y in range(6) for x in range(9)], np.float32)
        truth = np.array([0.1, -0.05, 0.001, 0, 0])
        views = [cv.projectPoints(board - (4, 2.5, 0), np.array(r, np.float64), np.array([0., 0., 14.]), K, truth)[0]
                 for r in [(0.4, 0, 0), (0, 0.5, 0), (-0.3, 0.3, 0.1), (0.2, -0.4, 0)]]
        found = cv.calibrateCamera([board] * len(views), [v.astype(np.float32) for v in views], SIZE, None, None)[1:3]
        camera = cv.rsackermann.RollingShutterCamera(SIZE, *found)
        camera.check()
        np.testing.assert_array_equal(camera.cameraMatrix, found[0])
        self.assertEqual(list(camera.distCoeffs), list(found[1].ravel()))

        fisheye = cv.rsackermann.LENS_FISHEYE
        for dist, lens in [(truth, 0), (truth[:4], fisheye)]:
            for shape in [(-1,), (1, -1), (-1, 1)]:
                for kind in [np.float32, np.float64]:
                    values = dist.astype(kind).reshape(shape)
                    camera = cv.rsackermann.RollingShutterCamera(SIZE, K, values, lens)
                    camera.check()
                    self.assertEqual(list(camera.distCoeffs), list(dist.astype(kind)))
                    self.assertEqual(camera.lensModel, lens)
        self.assertEqual(len(cv.rsackermann.RollingShutterCamera(SIZE, K, np.zeros((0, 1))).distCoeffs), 0)
        for values in [np.zeros((2, 4)), np.zeros((2, 2, 2)), np.zeros((5, 1), np.uint8), np.zeros((1, 3))]:
            with self.assertRaises(cv.error):
                cv.rsackermann.RollingShutterCamera(SIZE, K, values).check()

    def test_no_argument_harms_the_interpreter(self):
        """Every wrapped function with bad values of each type: another end than an exception of cv2 or Python's for
        arguments is a fault."""
        K = np.array([[816, 0, 320], [0, 816, 190], [0, 0, 1]], np.float64)
        skewed, unknown = K.copy(), K.copy()
        skewed[0, 1], unknown[0, 0] = 1, math.nan
        fisheye = cv.rsackermann.LENS_FISHEYE
        for arguments in [(SIZE, K, [1., 2., 3.]), (SIZE, K, [0.1] * 5, fisheye), (SIZE, K, [math.nan] * 4),
                          (SIZE, skewed, [0.1] * 4), (SIZE, skewed), (SIZE, unknown), ((0, -5), K), (SIZE, K, [], 7)]:
            camera = cv.rsackermann.RollingShutterCamera(*arguments)
            with self.assertRaises(cv.error):
                camera.check()
            with self.assertRaises(cv.error):
                cv.rsackermann.AckermannEstimator.create(camera)
            del camera

        values = [None, -1, 0, 10 ** 12, math.nan, math.inf, '', 'no such file', (), [], (1, 2), [1., math.nan], K,
                  skewed, np.zeros((0, 4), np.float32), np.ones((3, 3, 3)), np.ones((380, 640), np.int8), np.ones(5, complex)]
        camera = make_camera()
        module = cv.rsackermann
        objects = [camera, make_motion(camera), module.MotionPrior(), module.MetricMotion()]
        # A package of its own has classes of OpenCV's core as well.
        public = [f for name, f in vars(module).items() if not name.startswith('_') and not hasattr(cv, name)]
        classes = [c for c in public if isinstance(c, type)]
        classes += [c.Params for c in classes if hasattr(c, 'Params')]
        objects += [c.create(camera) for c in classes if hasattr(c, 'create')]
        functions = [f for f in public if callable(f) and f not in classes] + [module.RollingShutterCamera]
        for owner in objects + classes:
            is_algorithm = hasattr(owner, 'getDefaultName')  # whose functions are OpenCV's
            functions += [f for f in (getattr(owner, name) for name in dir(owner) if name[:2] != '__' and
                                      not (is_algorithm and hasattr(cv.Algorithm, name)))
                          if callable(f) and not isinstance(f, type)]
        self.assertGreater(len(functions), 100 if HAS_CORRECTOR else 80)
        for function in functions:
            # OpenCV's generator forgets the exception if a function without arguments gets some.
            takes_none = '()' in (function.__doc__ or '').split('\n')[0] and function is not module.RollingShutterCamera
            for count in range(1 if takes_none else 4):
                for i, value in enumerate(values):
                    arguments = ([value] + values[i:] + values)[:count]
                    try:
                        function(*arguments)
                    except (cv.error, TypeError, ValueError, OverflowError, UnicodeError):
                        pass

    def test_motion(self):
        camera = make_camera()
        motion = make_motion(camera)
        known, yaw_rate = motion.yawRate(camera)
        self.assertTrue(known)
        self.assertAlmostEqual(yaw_rate, YAW_RATE)
        known, speed = motion.speed(camera)
        self.assertTrue(known)
        self.assertAlmostEqual(speed, SPEED)
        self.assertAlmostEqual(motion.wallRatio, LEFT_WALL / RIGHT_WALL)

    def test_estimator(self):
        camera = make_camera()
        params = cv.rsackermann.AckermannEstimator.Params()
        params.wallDistance = LEFT_WALL
        params.wallDistanceLogSigma = 0  # segments end below the road
        params.gravitySigma = 0  # the camera is exactly upright
        estimator = cv.rsackermann.AckermannEstimator.create(camera, params)
        self.assertEqual(estimator.getParams().wallDistance, LEFT_WALL)

        segments = wall_segments(camera)
        self.assertGreater(len(segments), 20)
        motion, labels = estimator.estimate(segments)
        self.assertEqual(motion.status, cv.rsackermann.MOTION_OK)
        self.assertEqual(motion.model, cv.rsackermann.MODEL_4LA)
        self.assertAlmostEqual(motion.yawRate(camera)[1], YAW_RATE, delta=0.01 * YAW_RATE)
        self.assertAlmostEqual(motion.speed(camera)[1], SPEED, delta=0.01 * SPEED)
        walls = np.where(segments[:, 0] < SIZE[0] / 2,
                         cv.rsackermann.SEGMENT_LEFT_WALL, cv.rsackermann.SEGMENT_RIGHT_WALL)
        np.testing.assert_array_equal(np.ravel(labels), walls)

        motion, labels = estimator.estimate(segments[:1])
        self.assertEqual(motion.status, cv.rsackermann.MOTION_TOO_FEW_SEGMENTS)

    def test_maps(self):
        camera = make_camera()
        generator = cv.rsackermann.WarpMapGenerator.create(camera)
        motion = make_motion(camera)

        # A point on the left wall: where the maps find it in the raw image is where the simulation puts it.
        column, row = 150, 100
        x, y = (column - (SIZE[0] - 1) / 2.0) / FOCAL, (row - (SIZE[1] - 1) / 2.0) / FOCAL
        z = -LEFT_WALL / x
        map1, map2, mask = generator.initRectifyMap(motion)
        self.assertEqual(map1.shape, (SIZE[1], SIZE[0]))
        self.assertEqual(mask[row, column], 255)
        np.testing.assert_allclose((map1[row, column], map2[row, column]), project(camera, (x * z, y * z, z)),
                                   atol=0.01)

        # And the maps of the other direction lead back.
        back1, back2, _ = generator.initDistortMap(motion)
        there = map1[row, column], map2[row, column]
        self.assertAlmostEqual(float(cv.remap(back1, *(np.float32([[v]]) for v in there), cv.INTER_CUBIC)[0, 0]),
                               column, delta=0.05)
        self.assertAlmostEqual(float(cv.remap(back2, *(np.float32([[v]]) for v in there), cv.INTER_CUBIC)[0, 0]),
                               row, delta=0.05)

    def test_depth(self):
        camera = make_camera()
        motion = make_motion(camera)
        generator = cv.rsackermann.WarpMapGenerator.create(camera)
        metres = np.full(SIZE[::-1], 6, np.float32)
        metres[100:250, 200:300] = 3
        metres[:50] = np.nan
        depth = cv.rsackermann.DepthMap(metres)
        self.assertEqual((depth.camera, depth.scale, depth.empty()), (cv.rsackermann.DEPTH_RAW, 1, False))
        self.assertTrue(cv.rsackermann.DepthMap().empty())
        map1, map2, mask = generator.initRectifyMap(motion, depth=depth)
        self.assertTrue(np.isfinite(map1).all() and np.isfinite(map2).all())
        self.assertIn(cv.rsackermann.MASK_HIDDEN, mask)
        self.assertGreater(np.abs(map1 - generator.initRectifyMap(motion)[0])[mask == 255].max(), 0.5)

        millimetres = cv.rsackermann.DepthMap((np.nan_to_num(metres) * 1000).astype(np.uint16), scale=0.001)
        np.testing.assert_allclose(generator.initRectifyMap(motion, depth=millimetres)[0], map1, atol=1e-3)
        relative = cv.rsackermann.DepthMap(1 / metres - 2, kind=cv.rsackermann.DEPTH_RELATIVE)
        relative.scale = motion.wallDistance * np.hypot(motion.wallSlope, motion.wallOffset)
        relative.shift = 2 * relative.scale
        difference = np.abs(generator.initRectifyMap(motion, depth=relative)[0] - map1)
        self.assertGreater((difference < 1e-3).mean(), 0.999)  # rounding decides what is hidden beside an edge
        own = cv.rsackermann.DepthMap(metres, cv.rsackermann.DEPTH_CORRECTED)
        points = np.array([[250., 150], [400, 300]])
        raw = generator.distortPoints(motion, points, depths=np.array([3., 6]))[0]
        columns, rows, _ = generator.initRectifyMap(motion, depth=own)
        for point, place in zip(points.astype(int), raw):
            np.testing.assert_allclose((columns[point[1], point[0]], rows[point[1], point[0]]), place, atol=1e-3)
        cloud = cv.rsackermann.DepthMap.fromPoints(np.array([[0., 0, 7], [0, 0, 5], [0, 0, -1]]), camera)
        self.assertEqual((cloud.camera, cloud.values.shape, np.count_nonzero(cloud.values), cloud.values.max()),
                         (cv.rsackermann.DEPTH_CORRECTED, metres.shape, 1, 5))
        for bad in [metres[1:], metres.astype(np.float64)]:
            with self.assertRaisesRegex(cv.error, 'depth.values'):
                generator.initDistortMap(motion, depth=cv.rsackermann.DepthMap(bad))
        if HAS_CORRECTOR:
            corrector = cv.rsackermann.RollingShutterCorrector.create(camera)
            corrector.correctWithMotion(np.zeros(SIZE[::-1], np.uint8), motion, depth=depth)
            self.assertTrue(corrector.isDepthUsed())
            self.assertEqual(corrector.getUsedDepth().kind, cv.rsackermann.DEPTH_METRIC)
            np.testing.assert_array_equal(corrector.getMaps()[0], map1)

    @needs_corrector
    def test_corrector(self):
        corrector = cv.rsackermann.RollingShutterCorrector.create(make_camera())
        image = np.full((SIZE[1], SIZE[0], 3), 90, np.uint8)
        motion, corrected, mask = corrector.correct(image)
        self.assertEqual(motion.status, cv.rsackermann.MOTION_TOO_FEW_SEGMENTS)
        self.assertFalse(corrector.isTracked())
        np.testing.assert_array_equal(corrected, image)
        self.assertEqual(mask.min(), 255)
        with self.assertRaises(cv.error):
            corrector.correct(image[:-1])

    @needs_corrector
    def test_corrector_prior(self):
        params = cv.rsackermann.RollingShutterCorrector.Params()
        self.assertFalse(params.sequence)
        params.sequence = True
        params.frameInterval = 0.2
        corrector = cv.rsackermann.RollingShutterCorrector.create(make_camera(), params)
        self.assertEqual(corrector.getParams().frameInterval, 0.2)
        prior = cv.rsackermann.MotionPrior()
        prior.yawRate, prior.yawRateSigma = YAW_RATE, 0.01
        corrector.setPrior(prior)
        self.assertEqual(corrector.getPrior().yawRate, YAW_RATE)
        corrector.reset()

    @needs_corrector
    def test_corrector_gyro(self):
        corrector = cv.rsackermann.RollingShutterCorrector.create(make_camera())
        times = np.arange(0, 1, .01)
        rates = np.tile([.3, .2, -.1], (len(times), 1))  # rad/s
        corrector.addGyro(times[:50], rates[:50])
        corrector.addGyro(times[50:], rates[50:])
        self.assertRaises(cv.error, corrector.addGyro, times, rates)  # the same times again
        corrector.setTimestamp(.5)
        motion = corrector.correct(np.zeros((SIZE[1], SIZE[0]), np.uint8))[0]
        self.assertEqual(motion.status, cv.rsackermann.MOTION_OK)
        unit = make_camera().secondsPerUnitTime()
        self.assertAlmostEqual(motion.pitchRate / unit, -.3, places=6)
        self.assertAlmostEqual(2 * motion.alpha / unit, .2, places=6)
        self.assertAlmostEqual(motion.rollRate / unit, -.1, places=6)
        self.assertEqual(np.array(motion.rotationCurve).shape, (17, 3))
        self.assertTrue(corrector.isGyroUsed())
        self.assertLess(np.abs(np.array(motion.rotationCurve)).max(), 1e-9)  # the rates are constant
        agrees, delay, axes, bias = corrector.getGyroAlignment()
        self.assertTrue(agrees)
        self.assertEqual(delay, 0)
        self.assertEqual(len(axes), 3)
        self.assertEqual(len(bias), 3)
        corrector.clearGyro()
        corrector.setTimestamp(.5)
        motion = corrector.correct(np.zeros((SIZE[1], SIZE[0]), np.uint8))[0]
        self.assertNotEqual(motion.status, cv.rsackermann.MOTION_OK)

    @needs_corrector
    def test_fields_of_fields(self):
        # A field of a field would be one of a copy, so there is none.
        params = cv.rsackermann.RollingShutterCorrector.Params()
        for name in ('estimator', 'warp'):
            with self.assertRaises(AttributeError):
                getattr(params, name)
        estimator_params = params.getEstimatorParams()
        estimator_params.minLength = 40
        params.setEstimatorParams(estimator_params)
        warp_params = params.getWarpParams()
        warp_params.newSize = (320, 190)
        params.setWarpParams(warp_params)
        got = cv.rsackermann.RollingShutterCorrector.create(make_camera(), params).getParams()
        self.assertEqual(got.getEstimatorParams().minLength, 40)
        self.assertEqual(got.getWarpParams().newSize, (320, 190))


    def make_values(self):
        """One of each type, with values that aren't the defaults, and a function that tells them."""
        camera = make_camera()
        motion = make_motion(camera)
        motion.inverseDepthOffset = np.arange(30.0).reshape(5, 6) / 1000
        motion.offsetArea = (-0.5, -0.25, 1.125, 0.75)
        motion.rotationCurve = np.arange(12.0).reshape(4, 3) / 1000
        prior = cv.rsackermann.MotionPrior()
        prior.speed = 12.5
        estimator_params = cv.rsackermann.AckermannEstimator.Params()
        estimator_params.seed = 7
        warp_params = cv.rsackermann.WarpMapGenerator.Params()
        warp_params.tolerance = 1.0 / 3
        values = [
            (camera, lambda c: (c.lineDelay, c.height, c.imageSize, c.cameraMatrix.tolist())),
            (motion, lambda m: (m.status, m.alpha, m.wallSlope, m.wallOffset, m.wallRatio, m.roadSlope,
                                np.array(m.inverseDepthOffset).tolist(), m.offsetArea,
                                np.array(m.rotationCurve).tolist())),
            (prior, lambda p: (p.speed, p.yawRate)),
            (estimator_params, lambda p: p.seed),
            (warp_params, lambda p: p.tolerance),
        ]
        if HAS_CORRECTOR:
            corrector_params = cv.rsackermann.RollingShutterCorrector.Params()
            corrector_params.sequence = True
            corrector_params.setEstimatorParams(estimator_params)
            values.append((corrector_params, lambda p: (p.sequence, p.getEstimatorParams().seed)))
            calibrator_params = cv.rsackermann.MountCalibrator.Params()
            calibrator_params.maxFrames = 500
            values.append((calibrator_params, lambda p: p.maxFrames))
        return values

    def make_records(self):
        """The same of types that FileStorage doesn't hold."""
        metric = cv.rsackermann.MetricMotion()
        metric.speed, metric.leftDistance = 12.5, 3.0
        depth = cv.rsackermann.DepthMap(np.full((4, 6), 7, np.float32), kind=cv.rsackermann.DEPTH_RELATIVE)
        depth.shift = -0.5
        values = [
            (metric, lambda m: (m.speed, m.leftDistance, m.yawRate)),
            (depth, lambda d: (d.kind, d.shift, np.array(d.values).tolist())),
        ]
        if HAS_CORRECTOR:
            calibration = cv.rsackermann.MountCalibration()
            calibration.camera = make_camera()
            calibration.frames, calibration.rollObserved, calibration.rollSigma = 9, True, 0.25
            values.append((calibration, lambda c: (c.camera.lineDelay, c.camera.imageSize, c.frames, c.rollObserved,
                                                   c.rollSigma)))
        return values

    def test_pickle_and_copy(self):
        for value, state in self.make_values() + self.make_records():
            default = type(value)()
            self.assertNotEqual(state(value), state(default))
            for other in (pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value)):
                self.assertIs(type(other), type(value))
                self.assertEqual(state(other), state(value))

    def test_storage(self):
        for value, state in self.make_values():
            storage = cv.FileStorage('.yml', cv.FileStorage_WRITE + cv.FileStorage_MEMORY)
            value.write(storage)
            text = storage.releaseAndGetString()
            other = type(value)()
            storage = cv.FileStorage(text, cv.FileStorage_READ + cv.FileStorage_MEMORY)  # its nodes don't keep it alive
            other.read(storage.root())
            self.assertEqual(state(other), state(value))

    def test_save_and_load(self):
        params = cv.rsackermann.AckermannEstimator.Params()
        params.seed = 7
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'estimator.yml')
            cv.rsackermann.AckermannEstimator.create(make_camera(), params).save(path)
            loaded = cv.rsackermann.AckermannEstimator.load(path)
        self.assertEqual(loaded.getParams().seed, 7)
        self.assertEqual(loaded.getCamera().lineDelay, LINE_DELAY)

    @needs_corrector
    def test_sample(self):
        folder = os.path.dirname(os.path.abspath(__file__))
        sys.path.insert(0, os.path.join(folder, '..', '..', '..', 'samples'))
        from correct_frame import correct_frame
        del sys.path[0]

        camera = make_camera()
        image = np.full((SIZE[1], SIZE[0], 3), 90, np.uint8)
        for x1, y1, x2, y2 in np.round(wall_segments(camera) * 16).astype(int).tolist():  # 4 fractional bits
            cv.line(image, (x1, y1), (x2, y2), (250, 250, 250), 3, cv.LINE_AA, 4)
        motion, corrected, mask = correct_frame(image, LINE_DELAY, FOCAL)
        self.assertEqual(motion.status, cv.rsackermann.MOTION_OK)
        # Roll, which isn't known exactly, looks like a yaw rate.
        self.assertGreater(motion.expectedRaw, motion.expectedResidual)
        self.assertAlmostEqual(motion.yawRate(camera)[1], YAW_RATE,
                               delta=3 * math.sqrt(motion.metricCovariance(camera)[0][0]))
        self.assertEqual(corrected.shape, image.shape)
        self.assertEqual(mask.shape, image.shape[:2])

    def test_draw(self):
        camera = make_camera()
        motion = make_motion(camera)
        segments = wall_segments(camera)
        labels = np.full((len(segments), 1), cv.rsackermann.SEGMENT_OUTLIER, np.uint8)
        image = np.full((SIZE[1], SIZE[0], 3), 90, np.uint8)
        drawn = cv.rsackermann.drawMotion(image, segments, labels, camera, motion)
        x, y = np.round((segments[0, :2] + segments[0, 2:]) / 2).astype(int)
        self.assertEqual(drawn[y, x].tolist(), [0, 0, 0])


if __name__ == '__main__':
    NewOpenCVTests.bootstrap()
