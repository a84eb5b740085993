// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "information_bound.hpp"
#include "vertical_lines.hpp"

#include <cmath>

namespace paper {

using namespace cv::rsackermann;

namespace {

const double STEP = 1e-6; // of the finite differences

double difference(const RollingShutterCamera& camera, const cv::Vec4d& ends, const cv::Vec4d& motion)
{
    const MinimalSolution solution = {motion[0], motion[1], motion[2], motion[3]};
    return columnDifference(verticalSegment(camera, ends), solution, camera.heading) * camera.cameraMatrix(0, 0);
}

// By the motion, or by the ends.
template <typename Function>
cv::Vec4d gradient(const cv::Vec4d& at, double step, const Function& function)
{
    cv::Vec4d result;
    for (int i = 0; i < 4; i++)
    {
        cv::Vec4d low = at, high = at;
        low[i] -= step;
        high[i] += step;
        result[i] = (function(high) - function(low)) / (2 * step);
    }
    return result;
}

} // namespace

InformationBound informationBound(const RollingShutterCamera& camera, const cv::Mat& lines,
                                  const AckermannMotion& motion, double wallDistance, double noise)
{
    const cv::Vec4d values(motion.alpha, motion.wallSlope, motion.wallOffset, motion.wallRatio);
    cv::Matx44d information = cv::Matx44d::zeros();
    for (int i = 0; i < lines.rows; i++)
    {
        const cv::Vec4d ends = lines.at<cv::Vec4d>(i);
        const cv::Vec4d byEnds =
            gradient(ends, STEP * 1e3, [&](const cv::Vec4d& e) { return difference(camera, e, values); });
        const cv::Vec4d byMotion =
            gradient(values, STEP, [&](const cv::Vec4d& m) { return difference(camera, ends, m); });
        information += byMotion * byMotion.t() * (1 / (noise * noise * byEnds.dot(byEnds)));
    }
    const cv::Matx44d covariance = information.inv(cv::DECOMP_SVD);
    const double unit = camera.secondsPerUnitTime(), size = std::hypot(motion.wallSlope, motion.wallOffset);
    const cv::Vec4d bySpeed(0, motion.wallSlope / size * wallDistance / unit,
                            motion.wallOffset / size * wallDistance / unit, 0);
    return {2 * std::sqrt(covariance(0, 0)) / unit, std::sqrt(bySpeed.dot(covariance * bySpeed))};
}

} // namespace paper
