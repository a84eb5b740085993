// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "motion_samples.hpp"
#include <Eigen/Core>

namespace cv { namespace rsackermann {

Correction Correction::scaled(double factor) const
{
    Correction result = *this;
    result.model[P_ALPHA] *= factor;
    result.model[P_B] *= factor;
    result.model[P_D] *= factor;
    result.G *= factor;
    return result;
}

void MotionSamples::fieldOf(const Correction& correction, float* values) const
{
    DisplacementField::Values displacement;
    field.displacement(correction.model, correction.G, displacement);
    for (int k = 0; k < PADDED; k++)
    {
        const bool isPoint = k < DisplacementField::POINTS;
        values[k] = isPoint ? float(displacement[2 * k]) : 0;
        values[PADDED + k] = isPoint ? float(displacement[2 * k + 1]) : 0;
    }
}

static double meanDistance(const float* a, const float* b, int padded)
{
    typedef Eigen::Map<const Eigen::ArrayXf> Row;
    const Row ax(a, padded), ay(a + padded, padded), bx(b, padded), by(b + padded, padded);
    return ((ax - bx).square() + (ay - by).square()).sqrt().sum() / DisplacementField::POINTS;
}

void MotionSamples::addSample(const Model& model, double G, double weight)
{
    const float none[SIZE] = {};
    motions.push_back(Correction(model, G));
    weights.push_back(weight);
    fields.resize(fields.size() + SIZE);
    float* values = &fields[fields.size() - SIZE];
    fieldOf(motions.back(), values);
    raw.push_back(meanDistance(values, none, PADDED));
}

void MotionSamples::add(const Model& model, const Matx<double, PARAMETERS, PARAMETERS>& covariance, double weight)
{
    double G, variance;
    prior.road(model, contact, G, variance);
    const Parameter walls[3] = {P_B, P_D, P_LAMBDA};
    const int unknowns = model.direction == 0 ? 0 : model[P_LAMBDA] > 0 ? 3 : 2;
    if (unknowns == 0)
    {
        addSample(model, G, weight);
        return;
    }
    // Cholesky's factor; an unknown that the others determine has no spread of its own.
    Matx33d L = Matx33d::zeros();
    for (int j = 0; j < unknowns; j++)
        for (int i = j; i < unknowns; i++)
        {
            double sum = covariance(walls[i], walls[j]);
            for (int k = 0; k < j; k++)
                sum -= L(i, k) * L(j, k);
            L(i, j) = i == j ? std::sqrt(std::max(sum, 0.)) : L(j, j) > 0 ? sum / L(j, j) : 0;
        }
    const int count = unknowns + 1; // and the road
    const double spread = std::sqrt(double(count)), part = weight / (2 * count);
    for (int sign = -1; sign <= 1; sign += 2)
    {
        for (int j = 0; j < unknowns; j++)
        {
            Model moved = model;
            for (int i = j; i < unknowns; i++)
                moved[walls[i]] += sign * spread * L(i, j);
            moved[P_LAMBDA] = std::max(moved[P_LAMBDA], 0.);
            double movedG, movedVariance;
            prior.road(moved, contact, movedG, movedVariance);
            addSample(moved, movedG, part);
        }
        // Log-normal.
        addSample(model, G == 0 ? 0 : G * std::exp(sign * spread * std::sqrt(variance) / std::abs(G)), part);
    }
}

// Displacements are linear in these parameters: so is their mean, but for where planes meet.
Correction MotionSamples::mean(const std::vector<double>& share) const
{
    Correction result;
    Model& m = result.model;
    double sum = 0, right = 0, forward = 0;
    for (size_t i = 0; i < motions.size(); i++)
    {
        const Model& other = motions[i].model;
        const double w = share[i], speed = std::hypot(other[P_B], other[P_D]);
        sum += w;
        for (int p = 0; p < PARAMETERS; p++)
            m.value[p] += w * other.value[p];
        right += w * other[P_LAMBDA] * speed;
        result.G += w * motions[i].G;
        forward += w * other.direction * speed;
    }
    for (int p = 0; p < PARAMETERS; p++)
        m.value[p] /= sum;
    const double left = std::hypot(m[P_B], m[P_D]);
    m[P_LAMBDA] = left > 0 ? right / sum / left : 0;
    m.direction = forward < 0 ? -1 : 1;
    result.G /= sum;
    return result;
}

// Huber's location, by weights: beyond the mean distance a motion counts by its direction only.
Correction MotionSamples::middleOfMoving() const
{
    const int steps = 12;
    std::vector<double> moving(weights);
    double sum = 0;
    for (size_t i = 0; i < moving.size(); i++)
        sum += moving[i] = raw[i] > 0 ? weights[i] : 0;
    if (!(sum > 0))
        return Correction();
    Correction middle = mean(moving);
    std::vector<double> distance(moving.size()), share(moving.size());
    for (int step = 0; step < steps; step++)
    {
        float values[SIZE];
        fieldOf(middle, values);
        double meanOfAll = 0;
        for (size_t i = 0; i < moving.size(); i++)
        {
            distance[i] = meanDistance(&fields[i * SIZE], values, PADDED);
            meanOfAll += moving[i] / sum * distance[i];
        }
        for (size_t i = 0; i < moving.size(); i++)
            share[i] = moving[i] / std::max(std::max(meanOfAll, distance[i]), DBL_MIN);
        middle = mean(share);
    }
    return middle;
}

MotionSamples::Expectation MotionSamples::expect(const Correction& correction) const
{
    Expectation expected = {0, 0, 0, 0};
    float values[SIZE];
    fieldOf(correction, values);
    for (size_t i = 0; i < weights.size(); i++)
    {
        const double residual = meanDistance(&fields[i * SIZE], values, PADDED);
        expected.raw += weights[i] * raw[i];
        expected.residual += weights[i] * residual;
        expected.harm += weights[i] * std::max(0., residual - raw[i]);
        expected.probabilityWorse += residual > raw[i] ? weights[i] : 0;
    }
    return expected;
}

}} // namespace cv::rsackermann
