// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_TEST_PRIVATE_PROBLEM_HPP
#define OPENCV_RSACKERMANN_TEST_PRIVATE_PROBLEM_HPP

#include "test_simulator.hpp"
#include "../src/single/refinement.hpp"

namespace opencv_test {

//! What the estimator makes of segments before it fits anything, with nothing but the segments to go by.
inline RefinementProblem makeProblem(const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                                     const Mat& segments)
{
    const MotionLimits limits(camera, params);
    RefinementProblem problem(limits);
    problem.heading = camera.heading;
    problem.focal = camera.cameraMatrix(0, 0);
    problem.sigma = 0.25;
    problem.lossScale = 3;
    problem.gravitySigma = params.gravitySigma;
    problem.vehiclePitchSigma = params.vehiclePitchSigma;
    problem.streetDeviation = params.wallDeviationSigma;
    selectCandidates(segments, camera, params, problem.verticals, problem.others);
    problem.arrange();
    return problem;
}

//! The motion of a simulator in terms of the estimation.
inline Model modelOf(const simulation::Simulator& simulator)
{
    const Vec3d left = simulator.street.normal[simulation::LEFT] * simulator.drive.speed,
                right = simulator.street.normal[simulation::RIGHT] * simulator.drive.speed;
    const bool one = cv::norm(left) == 0;
    const Vec3d& first = one ? right : left;
    Model m;
    m.direction = simulator.drive.speed < 0 ? -1 : 1;
    m[P_ALPHA] = simulator.drive.yaw / 2;
    m[P_B] = -first[0];
    m[P_D] = first[2];
    m[P_LAMBDA] = one ? 0 : cv::norm(right) / cv::norm(left);
    return m;
}

} // namespace opencv_test

#endif // OPENCV_RSACKERMANN_TEST_PRIVATE_PROBLEM_HPP
