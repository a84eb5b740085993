// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "expected_displacement.hpp"
#include "../camera/line_delay_sigma.hpp"

namespace cv { namespace rsackermann {

Model expectDisplacement(const DisplacementField& field, const RollingShutterCamera& camera, const SequenceState& state,
                         bool isTurnAlone, double residual, AckermannMotion& motion)
{
    const double unit = camera.secondsPerUnitTime(), speed = state.value[SEQUENCE_SPEED],
                 road = state.value[SEQUENCE_ROAD], G = speed * unit * road;
    Matx<double, PARAMETERS, SEQUENCE_VALUES> byValues;
    const Model model = toModel(state.value, unit, &byValues);
    Matx<double, 1, SEQUENCE_VALUES> roadByValues;
    roadByValues(0, SEQUENCE_SPEED) = unit * road;
    roadByValues(0, SEQUENCE_ROAD) = unit * speed;
    DisplacementField::Values displacement, corrected, none;
    DisplacementField::Variances variances, exact;
    field.displacement(model, G, displacement);
    field.addTilt(RowTilt(camera, motion), displacement);
    corrected = displacement;
    if (isTurnAlone)
    {
        Model turn;
        turn[P_ALPHA] = model[P_ALPHA];
        field.displacement(turn, 0, corrected);
        field.addTilt(RowTilt(camera, motion), corrected);
    }
    field.variance(model, G, (roadByValues * state.covariance * roadByValues.t())(0),
                   byValues * state.covariance * byValues.t(), variances);
    field.addTiltVariance(motion.pitchRateSigma, motion.rollRateSigma, variances);
    motion.expectedRaw = DisplacementField::meanDistance(displacement, none, variances);
    // Motions per second displace by as much more as lines are read more slowly than is given.
    motion.expectedResidual = std::hypot(DisplacementField::meanDistance(displacement, corrected, variances),
                                         motion.expectedRaw * std::hypot(residual, relativeLineDelaySigma(camera)));
    motion.probabilityWorse = DisplacementField::probabilityWorse(
        DisplacementField::meanDistance(corrected, none, exact), motion.expectedResidual);
    return model;
}

void expectReadout(double ratio, AckermannMotion& motion)
{
    if (ratio == 1)
        return;
    const double given = motion.expectedRaw;
    // Worse if the true displacement is less than half of the given one, by an error of more than the rest.
    motion.probabilityWorse = DisplacementField::probabilityWorse((2 * ratio - 1) * given, motion.expectedResidual);
    motion.expectedRaw = std::abs(ratio) * given;
    motion.expectedResidual = std::hypot(motion.expectedResidual, (ratio - 1) * given);
}

void expectRowTurns(const DisplacementField& field, const RollingShutterCamera& camera, AckermannMotion& motion)
{
    DisplacementField::Values displacement, none;
    DisplacementField::Variances variances;
    field.addTilt(RowTilt(camera, motion), displacement);
    field.addTiltVariance(motion.pitchRateSigma, motion.rollRateSigma, variances);
    motion.expectedRaw = std::hypot(motion.expectedRaw, DisplacementField::meanDistance(displacement, none, variances));
    motion.expectedResidual =
        std::hypot(motion.expectedResidual, DisplacementField::meanDistance(none, none, variances));
}

}} // namespace cv::rsackermann
