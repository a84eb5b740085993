// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_PAPER_METHOD_HPP
#define RSACKERMANN_PERF_PAPER_METHOD_HPP

#include "opencv2/rsackermann.hpp"

namespace paper {

//! Input and limits of the method of the paper.
struct MethodParams
{
    int model;           //!< cv::rsackermann::MODEL_1LA, MODEL_3LA or MODEL_4LA
    double wallDistance; //!< metres to the left wall
    double threshold;    //!< pixels between the compensated columns of the two ends of an inlier
    double confidence;   //!< probability of having drawn a sample without outliers
    int maxIterations;   //!< largest number of samples
    int depthModel;      //!< the form of the cubic, see cv::rsackermann::SolverOptions
    double maxYawRate;   //!< radians per second
    double maxSpeed;     //!< metres per second
    int seed;

    MethodParams();
};

struct MethodResult
{
    cv::rsackermann::AckermannMotion motion;
    int iterations; //!< samples drawn
};

/** Algorithm 2 of the paper, from the public minimal solvers.

Segments whose ends are nowhere near the same column are left out, which hardly leaves out any. Samples are ordered from
left to right, all but the rightmost segment on the left wall. The motion with the most inliers wins. It isn't refined,
and nothing besides the segments is used.
@param segments N x 4 matrix CV_32F. */
MethodResult estimateAsPaper(const cv::rsackermann::RollingShutterCamera& camera, const cv::Mat& segments,
                             const MethodParams& params);

} // namespace paper

#endif // RSACKERMANN_PERF_PAPER_METHOD_HPP
