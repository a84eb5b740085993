// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_CONTESTANTS_HPP
#define RSACKERMANN_PERF_CONTESTANTS_HPP

#include "opencv2/rsackermann.hpp"
#include <functional>
#include <string>
#include <vector>

namespace paper {

//! Of the segments that all contestants are given: that of the paper.
const int DETECTOR = cv::rsackermann::DETECTOR_LSD;

//! The input of a contestant.
struct Problem
{
    cv::rsackermann::RollingShutterCamera camera; //!< as it is said to be
    cv::Mat segments;                             //!< N x 4 matrix CV_32F
    double wallDistance;                          //!< metres to the left wall, as it is said to be
    cv::rsackermann::MotionPrior prior;           //!< only the library makes use of it
    int seed;
};

struct Answer
{
    cv::rsackermann::AckermannMotion motion;
    int iterations; //!< samples drawn; -1 if unknown
};

struct Contestant
{
    std::string name;
    std::function<Answer(const Problem&)> estimate;
};

//! The paper's method with a model and a form of the cubic; see estimateAsPaper().
Contestant paperContestant(const std::string& name, int model, int depthModel = cv::rsackermann::DEPTH_ROLLING_SHUTTER);
//! The library at its defaults but for the model and, if it is exact, gravity.
Contestant libraryContestant(const std::string& name, int model, bool exactGravity);

//! paper, ours and ours_gravity.
std::vector<Contestant> mainContestants();
//! These, the paper's method with its smaller models and with the better cubic, and the library with exact gravity and
//! each model.
std::vector<Contestant> allContestants();

//! Yaw rate in deg/s and speed in km/h, 0 if the status says that nothing is corrected.
struct MetricEstimate
{
    double yawRate, speed;
    MetricEstimate(const cv::rsackermann::AckermannMotion& motion, const cv::rsackermann::RollingShutterCamera& camera);
};

} // namespace paper

#endif // RSACKERMANN_PERF_CONTESTANTS_HPP
