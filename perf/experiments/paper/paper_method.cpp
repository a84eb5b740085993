// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "paper_method.hpp"
#include "vertical_lines.hpp"

#include <algorithm>
#include <cmath>

namespace paper {

using namespace cv::rsackermann;

namespace {

const double LARGEST_DISTANCE = 0.5; // between the columns of the ends of a candidate, in units of the focal length

bool isLeftOf(const VerticalSegment& a, const VerticalSegment& b)
{
    return a.u.x / a.u.z + a.v.x / a.v.z < b.u.x / b.u.z + b.v.x / b.v.z;
}

std::vector<VerticalSegment> candidatesOf(const RollingShutterCamera& camera, const cv::Mat& segments)
{
    std::vector<VerticalSegment> candidates;
    for (int i = 0; i < segments.rows; i++)
    {
        const VerticalSegment s = verticalSegment(camera, cv::Vec4d(segments.at<cv::Vec4f>(i)));
        if (s.u.z > 0 && s.v.z > 0 && std::abs(s.u.x / s.u.z - s.v.x / s.v.z) <= LARGEST_DISTANCE)
            candidates.push_back(s);
    }
    return candidates;
}

int solve(int model, const VerticalSegment* sample, const SolverOptions& options, MinimalSolution solutions[3])
{
    return model == MODEL_1LA   ? solve1LA(sample[0], options, solutions)
           : model == MODEL_3LA ? solve3LA(sample, true, options, solutions)
                                : solve4LA(sample, true, options, solutions);
}

std::vector<VerticalSegment> drawSample(const std::vector<VerticalSegment>& candidates, int size, cv::RNG& rng)
{
    std::vector<int> chosen;
    std::vector<VerticalSegment> sample;
    while (int(chosen.size()) < size)
    {
        const int i = rng.uniform(0, int(candidates.size()));
        if (std::find(chosen.begin(), chosen.end(), i) != chosen.end())
            continue;
        chosen.push_back(i);
        sample.push_back(candidates[i]);
    }
    std::sort(sample.begin(), sample.end(), isLeftOf);
    return sample;
}

int samplesNeeded(double inlierRatio, int size, const MethodParams& params)
{
    const double good = std::pow(inlierRatio, size);
    if (good >= 1)
        return 1;
    const double needed = std::log(1 - params.confidence) / std::log(1 - good);
    return needed < params.maxIterations ? int(std::ceil(needed)) : params.maxIterations;
}

} // namespace

MethodParams::MethodParams()
    : model(MODEL_4LA), wallDistance(2.5), threshold(0.5), confidence(0.99), maxIterations(5000),
      depthModel(DEPTH_ROLLING_SHUTTER), maxYawRate(CV_PI / 2), maxSpeed(200 / 3.6), seed(0)
{
}

MethodResult estimateAsPaper(const RollingShutterCamera& camera, const cv::Mat& segments, const MethodParams& params)
{
    MethodResult result;
    result.iterations = 0;
    AckermannMotion& motion = result.motion;
    const std::vector<VerticalSegment> candidates = candidatesOf(camera, segments);
    motion.candidates = int(candidates.size());
    motion.model = params.model;
    motion.status = MOTION_TOO_FEW_SEGMENTS;
    const int size = params.model; // a model has the number of its lines
    if (int(candidates.size()) <= size)
        return result;

    SolverOptions options; // without a line delay there are no limits in metric units
    options.heading = camera.heading;
    if (camera.lineDelay > 0)
        options = solverLimits(camera, params.maxYawRate, params.maxSpeed, params.wallDistance);
    options.depthModel = params.depthModel;
    const double threshold = params.threshold / camera.cameraMatrix(0, 0);
    cv::RNG rng(uint64(params.seed) + 1);
    MinimalSolution best = MinimalSolution();
    for (int needed = params.maxIterations; result.iterations < needed; result.iterations++)
    {
        MinimalSolution solutions[3];
        const int count = solve(params.model, &drawSample(candidates, size, rng)[0], options, solutions);
        for (int k = 0; k < count; k++)
        {
            if (solutions[k].wallSlope < 0) // the paper's cars drive forward
                continue;
            int inliers = 0;
            for (const VerticalSegment& s : candidates)
                inliers += std::abs(columnDifference(s, solutions[k], camera.heading)) < threshold;
            if (inliers <= motion.inliers)
                continue;
            best = solutions[k];
            motion.inliers = inliers;
            needed = samplesNeeded(double(inliers) / double(candidates.size()), size, params);
        }
    }
    motion.status = motion.inliers > size ? MOTION_OK : MOTION_NO_CONSENSUS;
    if (motion.status != MOTION_OK)
        return result;
    motion.alpha = best.alpha;
    motion.wallSlope = best.wallSlope;
    motion.wallOffset = best.wallOffset;
    motion.wallRatio = best.wallRatio;
    if (params.model != MODEL_1LA)
    {
        motion.wallDistance = params.wallDistance;
        motion.scale = SCALE_WALL;
        if (camera.height > 0)
            motion.roadSlope = std::hypot(best.wallSlope, best.wallOffset) * params.wallDistance / camera.height;
    }
    return result;
}

} // namespace paper
