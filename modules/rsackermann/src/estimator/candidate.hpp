// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_ESTIMATOR_CANDIDATE_HPP
#define OPENCV_RSACKERMANN_SRC_ESTIMATOR_CANDIDATE_HPP

#include "opencv2/rsackermann/estimator.hpp"

namespace cv {
namespace rsackermann {

//! A segment that may be the image of a vertical line.
struct Candidate
{
    Vec3d u, v;          // upright bearings of the ends, with z = 1
    double timeU, timeV; // row times of the ends
    double length;       // pixels
    int index;           // among the segments of the caller
};

/** Limits of the motion in the units of the estimation.

Metric limits count where they can be expressed; the largest slant of a candidate always does.
*/
struct MotionLimits
{
    double maxAlpha;
    double maxSpeed; // of sqrt(B^2 + D^2)

    MotionLimits(const RollingShutterCamera& camera, const AckermannEstimator::Params& params);

    //! Largest |dx/dt| of the image of a vertical line at the column x (doc/theory.md, "Estimation").
    double maxSlant(double x, double heading) const;
};

/** The candidates among the segments, from left to right.
@param segments N x 4, CV_64F. Segments with coordinates that aren't finite are never candidates.
*/
void selectCandidates(const Mat& segments, const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                      std::vector<Candidate>& candidates);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_ESTIMATOR_CANDIDATE_HPP
