// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "sequence_filter.hpp"

namespace cv { namespace rsackermann {

bool SequenceFilter::isFollowedBy(double seconds) const
{
    return hasFrame && seconds != time && std::abs(seconds - time) < LONGEST_INTERVAL;
}

bool SequenceFilter::advance(double seconds, const RollingShutterCamera& camera,
                             const AckermannEstimator::Params& params)
{
    const bool follows = isFollowedBy(seconds);
    if (follows)
        state.predict(std::abs(seconds - time));
    else
        reset(camera, params);
    time = seconds;
    hasFrame = true;
    return follows;
}

bool SequenceFilter::update(const FrameFeatures& frame, const RollingShutterCamera& camera,
                            const AckermannEstimator::Params& params, SequenceFit& fit)
{
    fit = fitFrame(camera, frame.bearings, frame.verticals, state, isUninitialised);
    if (fit.agreeing < SAME_SCENE)
    {
        reset(camera, params);
        return false;
    }
    state = fit.state;
    isUninitialised = false;
    return true;
}

void SequenceFilter::reset(const RollingShutterCamera& camera, const AckermannEstimator::Params& params)
{
    state = SequenceState(camera, params);
    isUninitialised = true;
}

}} // namespace cv::rsackermann
