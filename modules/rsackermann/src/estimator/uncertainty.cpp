// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "uncertainty.hpp"
#include <Eigen/Cholesky>

namespace cv { namespace rsackermann {

typedef Matx<double, PARAMETERS, PARAMETERS> Covariance;

static const double SAME_MINIMUM = 0.2; // standard deviations between two minima that are one
static const double LARGEST_STEP = 0.1; // radians, the first one along the valley
static const double VALLEY_GROWTH = 1.5;
static const double FARTHEST = 0.5; // radians
static const double IMPOSSIBLE = 6; // logarithm of a probability: two of them end the valley
static const double HOPELESS = 30;  // the same; one is enough
static const double UNLIKELY = -14; // logarithm of the weight of another minimum

static double azimuthVariance(const Fit& fit)
{
    const double B = fit.model[P_B], D = fit.model[P_D], size2 = B * B + D * D;
    const Covariance& C = fit.covariance;
    return (B * B * C(P_D, P_D) + D * D * C(P_B, P_B) - 2 * B * D * C(P_B, P_D)) / (size2 * size2);
}

double logVolume(const Fit& fit)
{
    int free[PARAMETERS], n = 0;
    for (int i = 0; i < PARAMETERS; i++)
        if (fit.covariance(i, i) > 0)
            free[n++] = i;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, PARAMETERS, PARAMETERS> correlation(n, n);
    double sum = 0;
    for (int i = 0; i < n; i++)
    {
        const double variance = fit.covariance(free[i], free[i]);
        sum += 0.5 * std::log(variance);
        for (int j = 0; j < n; j++)
            correlation(i, j) =
                fit.covariance(free[i], free[j]) / std::sqrt(variance * fit.covariance(free[j], free[j]));
    }
    return sum + 0.5 * std::log(std::max(correlation.ldlt().vectorD().prod(), 1e-30));
}

// By how much the logarithm of a fit's likelihood is below that of the best one. The segments say less than their
// number, by the same factor as in the covariance.
static double worse(const Fit& fit, const Fit& best)
{
    return (fit.cost - best.cost) / (2 * best.inflation);
}

// Sum of mean square deviations from a model, each with the logarithm of its weight.
class Mixture
{
public:
    Mixture() : weight(0), logScale(-DBL_MAX) {}

    void add(double logWeight, const Covariance& deviation)
    {
        if (!(logWeight > -DBL_MAX))
            return;
        // The largest weight so far is 1: none overflows.
        if (logWeight > logScale)
        {
            const double rescaled = weight > 0 ? std::exp(logScale - logWeight) : 0;
            sum *= rescaled;
            weight *= rescaled;
            logScale = logWeight;
        }
        const double w = std::exp(logWeight - logScale);
        sum += w * deviation;
        weight += w;
    }

    Covariance mean() const { return sum * (1 / weight); }

private:
    Covariance sum;
    double weight, logScale;
};

// From one azimuth to another, less than half a turn.
static double angleBetween(double from, double to)
{
    return std::remainder(to - from, 2 * CV_PI);
}

// Whether the two are one minimum, found twice.
static bool isSame(const Fit& a, const Fit& b)
{
    const double near2 = SAME_MINIMUM * SAME_MINIMUM, alpha = a.model[P_ALPHA] - b.model[P_ALPHA];
    const double azimuth = angleBetween(azimuthOf(a.model), azimuthOf(b.model));
    return alpha * alpha <= near2 * a.covariance(P_ALPHA, P_ALPHA) && azimuth * azimuth <= near2 * azimuthVariance(a);
}

// Other minima to both sides along the direction in which the yaw rate is least known; the first one is the cheapest.
static std::vector<Fit> findMinima(const RefinementProblem& problem, const Fit& fit)
{
    std::vector<Fit> minima(1, fit);
    const double sigma = std::sqrt(fit.covariance(P_ALPHA, P_ALPHA)), steps[] = {-4, -2, 2, 4};
    for (int k = 0; k < 4; k++)
    {
        Model start = fit.model;
        for (int i = 0; i < PARAMETERS; i++)
            start.value[i] += steps[k] * fit.covariance(i, P_ALPHA) / sigma;
        if (problem.limits.allow(start))
            minima.push_back(refineFrom(problem, start, fit.hypothesis));
    }
    std::sort(minima.begin(), minima.end(), isCheaper);
    return minima;
}

// The model with walls along another azimuth and the other unknowns where they are to be expected then.
static Model predict(const MotionLimits& limits, const Fit& fit, double azimuth)
{
    const double B = fit.model[P_B], D = fit.model[P_D], size2 = B * B + D * D,
                 angle = angleBetween(azimuthOf(fit.model), azimuth);
    Model model = fit.model;
    for (int i = 0; i < PARAMETERS; i++)
        model.value[i] +=
            (B * fit.covariance(i, P_D) - D * fit.covariance(i, P_B)) / size2 / azimuthVariance(fit) * angle;
    model = turned(model, azimuth - azimuthOf(model));
    return limits.allow(model) ? model : turned(fit.model, angle);
}

// Adds a fit with walls along a given azimuth. Returns by how much it is worse than the best one.
static double addPinned(RefinementProblem& pinned, const PriorTerms& prior, const Fit& best, double azimuth,
                        double width, Fit& fit, Mixture& mixture)
{
    pinned.prior.street = azimuth;
    fit.model = predict(pinned.limits, fit, azimuth);
    fit.cost = refine(pinned, fit.hypothesis, ALL_SEGMENTS, 8, fit.model, &fit.covariance);
    if (prior.streetSigma > 0)
        fit.cost += std::pow(std::sin(azimuth - prior.street) / prior.streetSigma, 2);
    mixture.add(std::log(width) + logVolume(fit) - worse(fit, best), covarianceAround(fit, best.model));
    return worse(fit, best);
}

// Mean square deviation of the motion, integrated over the azimuth of the walls: what verticals alone say of it, and of
// all that depends on it, is far from normal. To both sides the steps grow, until the fits are as good as impossible.
static Covariance integrateOverAzimuth(const RefinementProblem& problem, const Fit& best)
{
    const double exactness = 1e-3;
    const double first = std::min(std::sqrt(azimuthVariance(best)), LARGEST_STEP), middle = azimuthOf(best.model);
    if (!(first > 0))
        return best.covariance;
    RefinementProblem pinned = problem;
    pinned.prior.streetSigma = exactness * first;
    Mixture mixture;
    Fit central = best;
    addPinned(pinned, problem.prior, best, middle, first, central, mixture);
    for (int side = -1; side <= 1; side += 2)
    {
        Fit fit = central;
        int tooExpensive = 0;
        // There may be a low place behind a high one, as verticals change from one wall to the other.
        for (double step = first, offset = first; tooExpensive < 2 && offset < FARTHEST;
             step *= VALLEY_GROWTH, offset += step)
        {
            const double excess = addPinned(pinned, problem.prior, best, middle + side * offset,
                                            (1 + VALLEY_GROWTH) / 2 * step, fit, mixture);
            tooExpensive = excess > HOPELESS ? 2 : excess > IMPOSSIBLE ? tooExpensive + 1 : 0;
        }
    }
    return mixture.mean();
}

void exploreValley(const RefinementProblem& problem, Fit& fit)
{
    if (fit.hypothesis.motion != MODEL_4LA || !(fit.covariance(P_ALPHA, P_ALPHA) > 0))
        return;
    const std::vector<Fit> minima = findMinima(problem, fit);
    fit = minima[0];
    Mixture mixture;
    mixture.add(0, integrateOverAzimuth(problem, fit));
    const double volume = logVolume(fit);
    for (size_t i = 1; i < minima.size(); i++)
    {
        const double logWeight = logVolume(minima[i]) - volume - worse(minima[i], fit);
        bool isNew = minima[i].model.direction == fit.model.direction;
        for (size_t j = 0; j < i && isNew; j++)
            isNew = !isSame(minima[i], minima[j]);
        if (isNew && logWeight > UNLIKELY)
            mixture.add(logWeight, covarianceAround(minima[i], fit.model));
    }
    fit.covariance = mixture.mean();
}

// A fit with another number of walls in terms of the best one: the same direction of the walls, and a ratio of the
// walls of which it says nothing.
static Fit inTermsOf(const Fit& best, const Fit& fit)
{
    Fit other = fit;
    if (other.model[P_B] * best.model[P_B] + other.model[P_D] * best.model[P_D] < 0)
    {
        other.model[P_B] *= -1;
        other.model[P_D] *= -1;
    }
    other.model[P_LAMBDA] = best.model[P_LAMBDA];
    for (int i = 0; i < PARAMETERS; i++)
        other.covariance(i, P_LAMBDA) = other.covariance(P_LAMBDA, i) = 0;
    other.covariance(P_LAMBDA, P_LAMBDA) = best.covariance(P_LAMBDA, P_LAMBDA);
    return other;
}

void addOtherHypotheses(const std::vector<Fit>& fits, Fit& best)
{
    if (!best.hypothesis.translates())
        return;
    // A motion without yaw doesn't say how well its yaw rate of 0 is known: the richer one does, as seen from it.
    for (size_t i = 0; i < fits.size(); i++)
        if (best.hypothesis.motion == MODEL_3LA && fits[i].hypothesis.motion == MODEL_4LA &&
            fits[i].hypothesis.walls == best.hypothesis.walls)
            best.covariance = covarianceAround(fits[i], best.model);
    Mixture mixture;
    mixture.add(0, best.covariance);
    for (size_t i = 0; i < fits.size(); i++)
    {
        if (fits[i].hypothesis.motion != MODEL_4LA || fits[i].hypothesis.walls == best.hypothesis.walls)
            continue;
        double lowest = fits[i].criterion;
        for (size_t j = 0; j < fits.size(); j++)
            if (fits[j].hypothesis.walls == fits[i].hypothesis.walls)
                lowest = std::min(lowest, fits[j].criterion);
        mixture.add(-(lowest - best.criterion) / 2, covarianceAround(inTermsOf(best, fits[i]), best.model));
    }
    best.covariance = mixture.mean();
}

}} // namespace cv::rsackermann
