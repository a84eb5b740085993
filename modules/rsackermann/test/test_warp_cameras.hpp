// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_TEST_RSACKERMANN_WARP_CAMERAS_HPP
#define OPENCV_TEST_RSACKERMANN_WARP_CAMERAS_HPP

#include "test_simulator.hpp"

namespace opencv_test {

//! The lens models of a camera; the numbers of BROWN_* are those of their coefficients.
enum TestLens { NO_LENS = 0, BROWN_4 = 4, BROWN_5 = 5, BROWN_8 = 8, BROWN_12 = 12, BROWN_14 = 14, FISHEYE_LENS = -4 };

#define ALL_LENSES NO_LENS, BROWN_4, BROWN_5, BROWN_8, BROWN_12, BROWN_14, FISHEYE_LENS

//! A camera with the timing of the paper's and a lens of the model.
inline cv::rsackermann::RollingShutterCamera lensCamera(int lens)
{
    static const double brown[14] = {-0.28, 0.09,   8e-4,  -6e-4,   -0.012, 0.11,  -0.04,
                                     0.01,  1.5e-3, -8e-4, -1.2e-3, 9e-4,   0.012, -0.017};
    static const double fisheye[4] = {-0.03, 0.012, -0.006, 0.001};
    cv::rsackermann::RollingShutterCamera camera = simulation::paperCamera();
    camera.cameraMatrix =
        lens == FISHEYE_LENS ? Matx33d(350, 0, 325, 0, 352, 184, 0, 0, 1) : Matx33d(816, 0, 313, 0, 809, 194, 0, 0, 1);
    if (lens == FISHEYE_LENS)
    {
        camera.lensModel = cv::rsackermann::LENS_FISHEYE;
        camera.distCoeffs.assign(fisheye, fisheye + 4);
    }
    else
        camera.distCoeffs.assign(brown, brown + lens);
    return camera;
}

//! A motion towards a wall across the road, as the left or the right one, that is reached at a row if the first one is
//! the reference row.
inline cv::rsackermann::AckermannMotion motionThroughWall(const cv::rsackermann::RollingShutterCamera& camera,
                                                          double row, bool isRight)
{
    const double nearness = 1 / camera.rowTime(Point2d(0, row));
    cv::rsackermann::AckermannMotion motion;
    motion.status = cv::rsackermann::MOTION_OK;
    motion.wallOffset = isRight ? -nearness / 2 : nearness;
    motion.wallRatio = isRight ? 2 : 0;
    return motion;
}

//! A motion sideways through the wall on one side, at that row, while the other wall and the road stay in sight.
inline cv::rsackermann::AckermannMotion motionSideways(cv::rsackermann::RollingShutterCamera& camera, double row,
                                                       bool toTheRight)
{
    const double speed = 20, near = speed * row * camera.lineDelay, far = 3;
    camera.referenceRow = 0;
    camera.heading = toTheRight ? CV_PI / 2 : -CV_PI / 2;
    return motionFromMetric(camera, 0, speed, toTheRight ? far : near, toTheRight ? near : far, 0);
}

//! A motion within the paper's limits, 10-140 km/h and up to 70 deg/s to either side, in a street of random width;
//! every second one rolls and pitches, too, and some of these by a curve.
inline cv::rsackermann::AckermannMotion randomMotion(const cv::rsackermann::RollingShutterCamera& camera, RNG& rng)
{
    const double sign = rng.uniform(0, 8) == 0 ? -1 : 1, wallDirection = camera.heading + rng.uniform(-0.05, 0.05),
                 right = rng.uniform(2., 4.), left = rng.uniform(2., 4.), speed = sign * rng.uniform(10., 140.) / 3.6,
                 yawRate = rng.uniform(-70., 70.) * CV_PI / 180;
    cv::rsackermann::AckermannMotion motion = motionFromMetric(camera, yawRate, speed, left, right, wallDirection);
    if (rng.uniform(0, 2))
    {
        const double most = 30 * CV_PI / 180 * camera.secondsPerUnitTime();
        motion.pitchRate = rng.uniform(-most, most);
        motion.rollRate = rng.uniform(-most, most);
        RNG ofCurve(rng.state); // the random numbers of what follows stay
        if (ofCurve.uniform(0, 2))
        {
            const int vectors = ofCurve.uniform(2, 12);
            addRotationCurve(motion, vectors, ofCurve);
        }
    }
    return motion;
}

//! Mounts the camera at random: any heading, or exactly forward, sideways or backward, and a tilt of a few degrees.
inline void mountAtRandom(cv::rsackermann::RollingShutterCamera& camera, RNG& rng)
{
    const double headings[] = {0, CV_PI / 2, -CV_PI / 2, CV_PI};
    camera.heading = rng.uniform(0, 2) ? rng.uniform(-CV_PI, CV_PI) : headings[rng.uniform(0, 4)];
    const Point2d rollPitch = uniformPoint(rng, Point2d(-0.1, -0.15), Point2d(0.1, 0.15));
    camera.setRollPitch(rollPitch.x, rollPitch.y);
    camera.referenceRow = rng.uniform(0., camera.imageSize.height - 1.);
}

} // namespace opencv_test

#endif // OPENCV_TEST_RSACKERMANN_WARP_CAMERAS_HPP
