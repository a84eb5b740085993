// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_FRAME_FIT_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_FRAME_FIT_HPP

#include "../factors/flow_residual.hpp"
#include "seen_camera.hpp"
#include "sequence_state.hpp"

namespace cv { namespace rsackermann {

//! A turn from or to another frame whose rate may change.
struct RowTurn
{
    double angle = 0; //!< of the reference row, radians; of yaw beyond that of the state
    double sigma = 0;
    //! By how much faster the present frame turns than the other one, rad/s: later rows turn further.
    double change = 0;
};

//! Those about all axes, as FLOW_PITCH_BEFORE and the others are counted.
struct NeighbourTurns
{
    RowTurn yaw, pitch, roll;
};

const double YAW_GROWTH = 3 * CV_PI / 180; //!< rad/s^2, of a car that steers gently

//! The evidence of a frame of a sequence.
struct SequenceFit
{
    SequenceState prediction;        //!< without the frame
    SequenceState state;             //!< prediction and frame together
    double values[FLOW_VALUES] = {}; //!< state and turns
    NeighbourTurns before, after;    //!< the same turns, with their changes
    bool moves = false;              //!< whether the points rule out a camera at rest
    bool stands = false;             //!< whether they rule out the predicted motion instead
    CameraEvidence camera;
    double yawGrowthSigma = YAW_GROWTH; //!< of its prior, rad/s^2
    double residual = 1;                //!< of the points that agree, over their displacement in the raw image
    double agreeing = 0; //!< share of the points that agree with the motion, without those on the car itself

    explicit SequenceFit(const SequenceState& prediction_) : prediction(prediction_), state(prediction_) {}
};

//! What a frame depends on beside the unknowns of the fit: standard deviations, and the read-out.
struct FitNuisances
{
    double pitchChange = 0, rollChange = 0; //!< of these rates from frame to frame, rad/s
    double yawGrowth = YAW_GROWTH;          //!< of the yaw rate between frames, rad/s^2
    double interval = 0;                    //!< relative, of the time between frames
    double curvature = 0;                   //!< of the way, 1/m, positive to the right
    double readoutRatio = 1;                //!< what the frames so far show of it, see SeenCamera
};

/** Fits motion, planes and gravity to the points that were tracked from the frame before, or to the one after, and to
the verticals of the present one, together with the state of the frames before (doc/theory.md, "Sequence").
@param prediction of the state at the present frame.
@param isUninitialised whether the prediction is hardly more than the usual values: motions that differ from it are
tried, too.
*/
SequenceFit fitFrame(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings,
                     const std::vector<UprightSegment>& verticals, const SequenceState& prediction,
                     bool isUninitialised, const FitNuisances& nuisances = FitNuisances());

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_FRAME_FIT_HPP
