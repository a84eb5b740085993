// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_EXPECTED_DISPLACEMENT_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_EXPECTED_DISPLACEMENT_HPP

#include "../single/displacement_field.hpp"
#include "sequence_state.hpp"

namespace cv { namespace rsackermann {

/** Sets the mean displacement by a motion, what is left of it after a correction, as far as the motion isn't known, and
the probability that this is worse.
@param field the places.
@param isTurnAlone whether only turns are corrected.
@param residual share of the displacement that is left where the state is right. */
Model expectDisplacement(const DisplacementField& field, const RollingShutterCamera& camera, const SequenceState& state,
                         bool isTurnAlone, double residual, AckermannMotion& motion);

/** Expects the displacements of a motion to be larger than those by the read-out that is given.
@param ratio of the read-outs: a correction by the given one leaves its difference from 1. */
void expectReadout(double ratio, AckermannMotion& motion);

//! Adds to the displacements of a motion what its rates of pitch and roll do, as far as they aren't known.
void expectRowTurns(const DisplacementField& field, const RollingShutterCamera& camera, AckermannMotion& motion);

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_EXPECTED_DISPLACEMENT_HPP
