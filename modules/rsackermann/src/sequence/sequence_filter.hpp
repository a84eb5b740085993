// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_SEQUENCE_FILTER_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_SEQUENCE_FILTER_HPP

#include "frame_fit.hpp"

namespace cv { namespace rsackermann {

//! The state of a sequence from frame to frame: predicted, measured and, if it is another scene, forgotten.
struct SequenceFilter
{
    SequenceState state;
    bool isUninitialised; //!< whether no frame has shown the motion yet
    bool hasFrame;
    double time; //!< of the last frame

    SequenceFilter(const RollingShutterCamera& camera, const AckermannEstimator::Params& params)
        : state(camera, params), isUninitialised(true), hasFrame(false), time(0)
    {
    }

    //! Whether a frame follows the last one; one that was taken before it is as good.
    bool isFollowedBy(double seconds) const
    {
        return hasFrame && seconds != time && std::abs(seconds - time) < LONGEST_INTERVAL;
    }

    /** Goes on to a frame; the state is forgotten if it doesn't follow.
    @return whether it does. */
    bool advance(double seconds, const RollingShutterCamera& camera, const AckermannEstimator::Params& params)
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

    /** Fits the state to a frame; it is forgotten if that shows another scene.
    @return whether the fit is one of this scene. */
    bool update(const FrameFeatures& frame, const RollingShutterCamera& camera,
                const AckermannEstimator::Params& params, SequenceFit& fit,
                const FitNuisances& nuisances = FitNuisances())
    {
        fit = fitFrame(camera, frame.bearings, frame.verticals, state, isUninitialised, nuisances);
        if (fit.agreeing < SAME_SCENE)
        {
            reset(camera, params);
            return false;
        }
        state = fit.state;
        isUninitialised = false;
        return true;
    }

    //! It is another scene.
    void reset(const RollingShutterCamera& camera, const AckermannEstimator::Params& params)
    {
        state = SequenceState(camera, params);
        isUninitialised = true;
    }
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_SEQUENCE_FILTER_HPP
