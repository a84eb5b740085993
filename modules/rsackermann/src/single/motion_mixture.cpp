// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "motion_mixture.hpp"
#include <Eigen/Eigenvalues>

namespace cv { namespace rsackermann {

namespace {

// A motion and the slope of the road's scaled inverse depth.
struct Correction
{
    Model model;
    double G;

    Correction() : G(0) {}
    Correction(const Model& model_, double G_) : model(model_), G(G_) {}

    // The same motion, slower or faster.
    Correction scaled(double factor) const
    {
        Correction result = *this;
        result.model[P_ALPHA] *= factor;
        result.model[P_B] *= factor;
        result.model[P_D] *= factor;
        result.G *= factor;
        return result;
    }
};

double meanDistance(const float* a, const float* b, int padded)
{
    typedef Eigen::Map<const Eigen::ArrayXf> Row;
    const Row ax(a, padded), ay(a + padded, padded), bx(b, padded), by(b + padded, padded);
    return ((ax - bx).square() + (ay - by).square()).sqrt().sum() / DisplacementField::POINTS;
}

// Covariance of the azimuth of the walls and of the logarithms of how fast the left (or only) and the right one pass:
// priors are log-normal, and a wall is as sure as it is seen, whatever the other one is.
Matx33d covarianceOfLogs(const Model& model, const Matx<double, PARAMETERS, PARAMETERS>& covariance)
{
    const double B = model[P_B], D = model[P_D], square = B * B + D * D, lambda = model[P_LAMBDA];
    Matx33d byLogs(-D / square, B / square, 0, B / square, D / square, 0, 0, 0, 0);
    if (lambda > 0)
    {
        byLogs(2, 0) = B / square;
        byLogs(2, 1) = D / square;
        byLogs(2, 2) = 1 / lambda;
    }

    Matx33d ofLogs = byLogs * covariance.get_minor<3, 3>(P_B, P_B) * byLogs.t();
    for (int i = 1; i < 3; i++)
    {
        const double relative = ofLogs(i, i), shorter = relative > 0 ? std::sqrt(std::log1p(relative) / relative) : 1;
        for (int k = 0; k < 3; k++)
        {
            ofLogs(i, k) *= shorter;
            ofLogs(k, i) *= shorter;
        }
    }

    return ofLogs;
}

// Motions with weights, and their displacement fields: what a decision is made over.
class MotionSamples
{
public:
    MotionSamples(const DisplacementField& field_, const DrivingPrior& prior_, const RoadLimit& limit_)
        : field(field_), prior(prior_), limit(limit_)
    {
    }

    // Adds the sigma points of a motion with uncertain walls and road, two for each unknown, by the covariance of the
    // model's B, D and lambda.
    void add(const Model& model, const Matx<double, PARAMETERS, PARAMETERS>& covariance, double weight)
    {
        double G, variance;
        prior.road(model, limit, G, variance);
        const double size = std::hypot(model[P_B], model[P_D]), azimuth = std::atan2(model[P_D], model[P_B]);
        const int unknowns = size == 0 ? 0 : model[P_LAMBDA] > 0 ? 3 : 2;
        if (unknowns == 0)
        {
            addSample(model, G, weight);
            return;
        }

        const Matx33d ofLogs = covarianceOfLogs(model, covariance);
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(Eigen::Map<const Eigen::Matrix3d>(ofLogs.val));
        const int count = unknowns + 1; // and the road
        const double spread = std::sqrt(double(count)), part = weight / (2 * count);
        for (int sign = -1; sign <= 1; sign += 2)
        {
            for (int j = 3 - unknowns; j < 3; j++)
            {
                const Eigen::Vector3d step =
                    sign * spread * std::sqrt(std::max(axes.eigenvalues()[j], 0.)) * axes.eigenvectors().col(j);
                Model moved = model;
                moved[P_B] = size * std::exp(step[1]) * std::cos(azimuth + step[0]);
                moved[P_D] = size * std::exp(step[1]) * std::sin(azimuth + step[0]);
                moved[P_LAMBDA] *= std::exp(step[2] - step[1]);
                double movedG, movedVariance;
                prior.road(moved, limit, movedG, movedVariance);
                addSample(moved, movedG, part);
            }
            // Log-normal.
            addSample(model, G == 0 ? 0 : G * std::exp(sign * spread * std::sqrt(variance) / std::abs(G)), part);
        }
    }

    // Huber's location, by weights: beyond the mean distance a motion counts by its direction only.
    Correction middleOfMoving() const
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

    struct Expectation
    {
        double raw, residual;    // mean displacements before and after the correction, pixels
        double harm;             // E[max(0, residual - raw)]
        double probabilityWorse; // that the residual is larger than the raw displacement
    };

    // What becomes of the image by a correction.
    Expectation expect(const Correction& correction) const
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

private:
    // Horizontal, then vertical displacements of a field, in single precision and padded: distances between thousands
    // of them are needed.
    enum { PADDED = (DisplacementField::POINTS + 7) / 8 * 8, SIZE = 2 * PADDED };

    void addSample(const Model& model, double G, double weight)
    {
        const float none[SIZE] = {};
        motions.push_back(Correction(model, G));
        weights.push_back(weight);
        fields.resize(fields.size() + SIZE);
        float* values = &fields[fields.size() - SIZE];
        fieldOf(motions.back(), values);
        raw.push_back(meanDistance(values, none, PADDED));
    }

    // Beyond what an image can be displaced by: its square is finite.
    static float rounded(double pixels) { return float(std::min(std::max(pixels, -1e15), 1e15)); }

    void fieldOf(const Correction& correction, float* values) const
    {
        DisplacementField::Values displacement;
        field.displacement(correction.model, correction.G, displacement);
        for (int k = 0; k < PADDED; k++)
        {
            const bool isPoint = k < DisplacementField::POINTS;
            values[k] = isPoint ? rounded(displacement[2 * k]) : 0;
            values[PADDED + k] = isPoint ? rounded(displacement[2 * k + 1]) : 0;
        }
    }

    // Displacements are linear in the planes: so is their mean, but for where planes meet. A wall on the right alone is
    // one of the right walls.
    Correction mean(const std::vector<double>& share) const
    {
        Correction result;
        Model& m = result.model;
        double sum = 0, forward = 0;
        Vec2d left(0, 0), right(0, 0); // (B, D), of the right wall as if it were on the left
        for (size_t i = 0; i < motions.size(); i++)
        {
            const Model& other = motions[i].model;
            const double w = share[i];
            const Vec2d wall(other[P_B], other[P_D]);
            sum += w;
            for (int p = 0; p < PARAMETERS; p++)
                m.value[p] += w * other.value[p];
            if (hasRightWallOnly(other, prior.heading()))
                right -= w * wall;
            else
            {
                left += w * wall;
                right += w * other[P_LAMBDA] * wall;
            }
            result.G += w * motions[i].G;
            forward += w * other.direction * norm(wall);
        }

        for (int p = 0; p < PARAMETERS; p++)
            m.value[p] /= sum;
        // Both are parallel.
        const Vec2d both = left + right, street = both / std::max(norm(both), DBL_MIN);
        const double l = left.dot(street), r = right.dot(street);
        const Vec2d wall = street * ((l > 0 ? l : -r) / sum);
        m[P_B] = wall[0];
        m[P_D] = wall[1];
        m[P_LAMBDA] = l > 0 ? std::max(r, 0.) / l : 0;
        m.direction = forward < 0 ? -1 : 1;
        result.G /= sum;
        return result;
    }

    const DisplacementField& field;
    const DrivingPrior& prior;
    const RoadLimit& limit;
    std::vector<Correction> motions;
    std::vector<double> weights; // their sum is 1
    std::vector<float> fields;
    std::vector<double> raw; // mean displacements
};

} // namespace

void MotionMixture::add(const Fit& fit, double logWeight, MotionUse use)
{
    if (!(logWeight > -DBL_MAX && logWeight < DBL_MAX))
        return;
    components.push_back({fit, logWeight, use});
    largest = std::max(largest, logWeight);
}

double MotionMixture::logSum() const
{
    double sum = 0;
    for (const Component& c : components)
        sum += c.use != TO_DECIDE ? std::exp(c.logWeight - largest) : 0;
    return largest + std::log(sum);
}

std::vector<double> MotionMixture::probabilities() const
{
    const double all = logSum();
    std::vector<double> probability;
    for (const Component& c : components)
        probability.push_back(std::exp(c.logWeight - all));
    return probability;
}

// The loss is convex in the fraction of the correction that is applied: golden-section search, if all of it isn't best.
static double bestFraction(const MotionSamples& samples, const Correction& correction, double harmAversion)
{
    const double golden = (std::sqrt(5.) - 1) / 2, accuracy = 0.005;
    const auto loss = [&](double fraction) {
        const MotionSamples::Expectation e = samples.expect(correction.scaled(fraction));
        return e.residual + harmAversion * e.harm;
    };
    const double none = loss(0), all = loss(1), least = 0.01 * none; // by less nothing is to be gained
    if (all <= loss(1 - accuracy))
        return all < none - least ? 1 : 0;
    double low = 0, high = 1, a = high - golden, b = low + golden, lossA = loss(a), lossB = loss(b);
    while (high - low > accuracy)
    {
        if (lossA < lossB)
        {
            high = b;
            b = a;
            lossB = lossA;
            a = high - golden * (high - low);
            lossA = loss(a);
        }
        else
        {
            low = a;
            a = b;
            lossA = lossB;
            b = low + golden * (high - low);
            lossB = loss(b);
        }
    }

    const double middle = (low + high) / 2, ofMiddle = loss(middle);
    const bool applyAll = all < ofMiddle + least;
    return (applyAll ? all : ofMiddle) < none - least ? (applyAll ? 1 : middle) : 0;
}

Posterior MotionMixture::best() const
{
    const std::vector<double> probability = probabilities();
    const auto add = [&](MotionUse use, MotionSamples& samples) {
        for (size_t i = 0; i < components.size(); i++)
            if (components[i].use == use && probability[i] > NEGLIGIBLE)
                samples.add(components[i].fit.model, components[i].fit.covariance, probability[i]);
    };
    MotionSamples samples(field, prior, limit);
    add(FOR_ALL, samples);
    MotionSamples deciding = samples;
    add(TO_DECIDE, deciding);
    add(TO_EXPECT, samples);
    Correction correction = deciding.middleOfMoving();
    correction = correction.scaled(bestFraction(deciding, correction, harmAversion));
    const MotionSamples::Expectation expected = samples.expect(correction);

    Posterior result;
    result.model = correction.model;
    result.G = correction.G;
    double expectedG, expectedVariance, G, variance;
    prior.road(result.model, RoadLimit(), expectedG, expectedVariance);
    prior.road(result.model, limit, G, variance);
    const double information = G * G / variance, expectedInformation = expectedG * expectedG / expectedVariance;
    result.contradictsWall = prior.wallIsGiven() && !prior.speedIsGiven() && expectedVariance > 0 &&
                             std::abs(std::log(G / expectedG)) * std::sqrt(expectedInformation) > CONTRADICTION;
    if (result.contradictsWall || (prior.roadIsSought() && information > 2 * expectedInformation))
        result.roadSigma = 1 / std::sqrt(information);
    result.expectedRaw = expected.raw;
    result.expectedResidual = expected.residual;
    result.probabilityWorse = expected.probabilityWorse;
    double translating[3] = {0, 0, 0};
    for (size_t i = 0; i < components.size(); i++)
    {
        const Fit& fit = components[i].fit;
        if (components[i].use == TO_DECIDE)
            continue;
        const Vec<double, PARAMETERS> difference = fit.model.value - result.model.value;
        result.covariance += probability[i] * (fit.covariance + difference * difference.t());
        translating[fit.hypothesis.walls] += fit.hypothesis.translates() ? probability[i] : 0;
    }

    result.hypothesis = MotionHypothesis(field.mainMotion(result.model, result.G), 0);
    if (result.hypothesis.translates())
        result.hypothesis.walls = translating[2] > translating[1] ? 2 : 1;
    return result;
}

}} // namespace cv::rsackermann
