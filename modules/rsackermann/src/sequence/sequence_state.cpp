// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../single/inliers_and_scale.hpp"
#include "../factors/driving_prior.hpp"
#include "../motion/contradiction.hpp"
#include "sequence_state.hpp"

namespace cv { namespace rsackermann {

const double MEMORY[SEQUENCE_VALUES] = {2, 10, 1, 1, 1, 1, 10, 10};

SequenceState::SequenceState(const RollingShutterCamera& camera, const AckermannEstimator::Params& params)
{
    stationaryState(camera, params, stationary, stationarySigma);
    value = stationary;
    covariance = SequenceMatrix::diag(stationarySigma.mul(stationarySigma));
}

void SequenceState::predict(double seconds)
{
    SequenceVector kept;
    for (int i = 0; i < SEQUENCE_VALUES; i++)
        kept[i] = std::exp(-seconds / MEMORY[i]);
    value = stationary + kept.mul(value - stationary);
    byCamera = SequenceMatrix::diag(kept) * byCamera;
    covariance = covariance.mul(kept * kept.t());
    for (int i = 0; i < SEQUENCE_VALUES; i++)
        covariance(i, i) += (1 - kept[i] * kept[i]) * stationarySigma[i] * stationarySigma[i];
}

void SequenceState::measure(SequenceValue which, double measured, double sigma)
{
    if (!(sigma > 0))
        return;
    const SequenceVector column(covariance.col(which).val);
    const SequenceVector gain = column * (1 / (covariance(which, which) + sigma * sigma));
    value += gain * (measured - value[which]);
    byCamera -= gain * byCamera.row(which);
    covariance -= gain * column.t();
}

void SequenceState::measure(const MotionPrior& prior)
{
    measure(SEQUENCE_YAW_RATE, prior.yawRate, prior.yawRateSigma);
    measure(SEQUENCE_SPEED, prior.speed, prior.speedSigma);
    measure(SEQUENCE_DIRECTION, prior.wallDirection, prior.wallDirectionSigma);
}

void SequenceState::scale(SequenceValue which, double factor)
{
    for (int i = 0; i < SEQUENCE_VALUES; i++)
    {
        covariance(which, i) *= factor;
        covariance(i, which) *= factor;
    }
}

void SequenceState::change(const RollingShutterCamera& camera, const AckermannEstimator::Params& params, int kept)
{
    const SequenceState before = *this;
    *this = SequenceState(camera, params);
    for (int i = 0; i < kept; i++)
    {
        value[i] = before.value[i];
        for (int j = 0; j < CAMERA_VALUES; j++)
            byCamera(i, j) = before.byCamera(i, j);
        for (int j = 0; j < kept; j++)
            covariance(i, j) = before.covariance(i, j);
    }
}

void SequenceState::seen(SequenceValue which, double& mean, double& sigma) const
{
    const double information = 1 / covariance(which, which),
                 usual = 1 / (stationarySigma[which] * stationarySigma[which]), own = information - usual;
    if (!(own > 0))
        return;
    mean = (value[which] * information - stationary[which] * usual) / own;
    sigma = 1 / std::sqrt(own);
}

void SequenceState::change(const CameraVector& difference)
{
    value += byCamera * difference;
    for (int i = SEQUENCE_LEFT; i <= SEQUENCE_ROAD; i++)
        value[i] = std::max(value[i], 0.);
    stationary[SEQUENCE_DIRECTION] += difference[CAMERA_HEADING];
}

SequenceState SequenceState::marginal(const CameraMatrix& ofCamera) const
{
    SequenceState result = *this;
    result.covariance += byCamera * ofCamera * byCamera.t();
    return result;
}

bool SequenceState::excludesRest() const
{
    const auto isBeyond = [](double x, double variance) { return std::abs(x) > CONTRADICTION * std::sqrt(variance); };
    const double v = value[SEQUENCE_SPEED], ofSpeed = covariance(SEQUENCE_SPEED, SEQUENCE_SPEED);
    bool excludes =
        isBeyond(value[SEQUENCE_YAW_RATE], covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE)) || isBeyond(v, ofSpeed);
    for (int i = SEQUENCE_LEFT; i <= SEQUENCE_ROAD; i++)
    {
        const double x = value[i],
                     variance = x * x * ofSpeed + 2 * x * v * covariance(SEQUENCE_SPEED, i) + v * v * covariance(i, i);
        excludes |= isBeyond(v * x, std::max(variance, 0.));
    }
    return excludes;
}

void SequenceState::toMotion(double unit, AckermannMotion& motion) const
{
    Matx<double, PARAMETERS, SEQUENCE_VALUES> J;
    const Model m = toModel(value, unit, &J);
    setModel(m, value[SEQUENCE_SPEED] * unit * value[SEQUENCE_ROAD], J * covariance * J.t(), motion);
}

}} // namespace cv::rsackermann
