// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "residual_kernels.hpp"

#include "residual_kernels.simd.hpp"
#include "factors/residual_kernels.simd_declarations.hpp"

namespace cv { namespace rsackermann {

void addVerticals(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                  const FreeParameters& unknowns, ResidualSums& sums)
{
    CV_CPU_DISPATCH(addVerticals, (segments, model, loss, unknowns, sums), CV_CPU_DISPATCH_MODES_ALL);
}

void addDirections(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                   const FreeParameters& unknowns, ResidualSums& sums)
{
    CV_CPU_DISPATCH(addDirections, (segments, model, loss, unknowns, sums), CV_CPU_DISPATCH_MODES_ALL);
}

void addVerticalsInSinglePrecision(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                                   const FreeParameters& unknowns, ResidualSums& sums)
{
    CV_CPU_DISPATCH(addVerticalsInSinglePrecision, (segments, model, loss, unknowns, sums), CV_CPU_DISPATCH_MODES_ALL);
}

double scoreVerticals(const SegmentArrays& segments, const PreparedModel& model, double focal, double threshold,
                      double best, int& inliers)
{
    CV_CPU_DISPATCH(scoreVerticals, (segments, model, focal, threshold, best, inliers), CV_CPU_DISPATCH_MODES_ALL);
}

void compensateSegments(const SegmentArrays& segments, const PreparedModel& model, float* points)
{
    CV_CPU_DISPATCH(compensateSegments, (segments, model, points), CV_CPU_DISPATCH_MODES_ALL);
}

double streetCost(const float* points, int padded, double streetX, double streetZ, double scale)
{
    CV_CPU_DISPATCH(streetCost, (points, padded, streetX, streetZ, scale), CV_CPU_DISPATCH_MODES_ALL);
}

SlantSums sumSlants(const Slants& slants, const SlantNoise& noise, double error)
{
    CV_CPU_DISPATCH(sumSlants, (slants, noise, error), CV_CPU_DISPATCH_MODES_ALL);
}

double slantLikelihood(const Slants& slants, const SlantNoise& noise, double error)
{
    CV_CPU_DISPATCH(slantLikelihood, (slants, noise, error), CV_CPU_DISPATCH_MODES_ALL);
}

}} // namespace cv::rsackermann
