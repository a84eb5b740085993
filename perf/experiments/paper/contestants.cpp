// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "contestants.hpp"
#include "paper_method.hpp"
#include "setting.hpp"

namespace paper {

using namespace cv::rsackermann;

Contestant paperContestant(const std::string& name, int model, int depthModel)
{
    return {name, [model, depthModel](const Problem& problem) {
                MethodParams params;
                params.model = model;
                params.depthModel = depthModel;
                params.wallDistance = problem.wallDistance;
                params.seed = problem.seed;
                const MethodResult result = estimateAsPaper(problem.camera, problem.segments, params);
                return Answer{result.motion, result.iterations};
            }};
}

Contestant libraryContestant(const std::string& name, int model, bool exactGravity)
{
    return {name, [model, exactGravity](const Problem& problem) {
                AckermannEstimator::Params params;
                params.model = model;
                params.wallDistance = problem.wallDistance;
                params.wallDistanceLogSigma = 0;
                params.seed = problem.seed;
                if (exactGravity)
                    params.gravitySigma = 0;
                return Answer{AckermannEstimator::create(problem.camera, params)
                                  ->estimate(problem.segments, cv::noArray(), problem.prior),
                              -1};
            }};
}

std::vector<Contestant> mainContestants()
{
    return {paperContestant("paper", MODEL_4LA), libraryContestant("ours", MODEL_AUTO, false),
            libraryContestant("ours_gravity", MODEL_AUTO, true)};
}

std::vector<Contestant> allContestants()
{
    std::vector<Contestant> all = mainContestants();
    all.push_back(paperContestant("paper_1la", MODEL_1LA));
    all.push_back(paperContestant("paper_3la", MODEL_3LA));
    all.push_back(paperContestant("paper_global", MODEL_4LA, DEPTH_GLOBAL_SHUTTER));
    all.push_back(libraryContestant("ours_1la", MODEL_1LA, true));
    all.push_back(libraryContestant("ours_3la", MODEL_3LA, true));
    all.push_back(libraryContestant("ours_4la", MODEL_4LA, true));
    return all;
}

MetricEstimate::MetricEstimate(const AckermannMotion& motion, const RollingShutterCamera& camera) : yawRate(0), speed(0)
{
    if (motion.status != MOTION_OK)
        return;
    motion.yawRate(camera, yawRate);
    motion.speed(camera, speed);
    yawRate /= DEGREE;
    speed /= KMH;
}

} // namespace paper
