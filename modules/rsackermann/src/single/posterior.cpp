// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../factors/segment_residuals.hpp"
#include "../factors/slant_noise.hpp"
#include "../factors/robust_losses.hpp"
#include "../optim/median.hpp"
#include "../parallel_loop.hpp"
#include "consensus.hpp"
#include "lo_ransac.hpp"
#include "motion_mixture.hpp"
#include "peak_moments.hpp"
#include "yaw_sweep.hpp"

namespace cv { namespace rsackermann {

// doc/theory.md, "Evidence" and "Posterior", have the reasons.
static const double DEPENDENCE_OF_OTHERS = 3;       // over that of the verticals
static const double OTHER_LENSES[] = {-1, 1, 2, 3}; // sigmas of a distortion that isn't known

namespace {

const Fit& cheapest(const std::vector<Fit>& fits)
{
    return *std::min_element(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return a.cost < b.cost; });
}

// By how much the candidates lean that a model should have made upright.
Slants slantsOf(const RefinementProblem& problem, const Model& model, bool translates)
{
    const PreparedModel prepared(model, problem.heading, problem.roadRatio, translates);
    Slants slants;
    for (const UprightSegment& c : problem.verticals)
    {
        int wall;
        slants.length.push_back(norm(c.u - c.v));
        slants.slant.push_back(verticalResidual(c, prepared, wall, 0) / slants.length.back());
    }
    return slants;
}

// A motion hypothesis with the logarithm of its prior probability over that of a motion at all.
struct WeighedHypothesis
{
    MotionHypothesis hypothesis;
    double logPrior;
    // Starts, and then all that they lead to.
    std::vector<Fit> minima;

    WeighedHypothesis(const MotionHypothesis& h, double logPrior_) : hypothesis(h), logPrior(logPrior_) {}

    void addMinimum(const Fit& fit)
    {
        const auto isSame = [&](const Fit& other) { return isAt(other, fit.model); };
        if (fit.cost < DBL_MAX && std::none_of(minima.begin(), minima.end(), isSame))
            minima.push_back(fit);
    }

    // Minima that have become the same are one, and those that are too far above the least are none.
    void keepDistinct(double tooFar)
    {
        std::vector<Fit> refined;
        refined.swap(minima);
        std::sort(refined.begin(), refined.end(), [](const Fit& a, const Fit& b) { return a.cost < b.cost; });
        for (size_t i = 0; i < refined.size() && refined[i].cost <= refined[0].cost + tooFar; i++)
            addMinimum(refined[i]);
    }
};

class Explorer
{
public:
    Explorer(RefinementProblem& problem_, const AckermannEstimator::Params& params_, const DisplacementField& field)
        : problem(problem_), params(params_), prior(*problem_.prior), mixture(field, prior, params_.harmAversion)
    {
    }

    bool run(Posterior& result)
    {
        if (!problem.noiseIsKnown)
        {
            problem.lossScale = SLANT_SCALE; // until then
            problem.lean = 0;
            problem.weigh();
        }
        dependence = dependenceOf(problem.rollSigma());
        std::vector<WeighedHypothesis> all = hypotheses();
        forEachInParallel(int(all.size()),
                          [&](int i) { all[i].minima = i == 0 ? startsAtRest() : allowedStarts(all[i].hypothesis); });
        refineAll(all);
        if (all[0].minima.empty())
            return false;
        measureNoise(all);
        keepMostProbable(all[0].minima);
        mixture.setRoadLimit(roadLimit(all));
        if (problem.distortionSigma > 0)
            addRestThroughOtherLenses(all[0]);
        addSceneWithoutVerticals(all[0].minima[0]);
        addAll(all);
        result = mixture.best();
        Vec<double, PARAMETERS> byAzimuth; // derivative of the model
        byAzimuth[P_B] = -result.model[P_D];
        byAzimuth[P_D] = result.model[P_B];
        result.covariance += varianceOfOtherStreets(problem, leastOf(all)) * byAzimuth * byAzimuth.t();
        return true;
    }

private:
    // The first one is that of a camera at rest.
    std::vector<WeighedHypothesis> hypotheses() const
    {
        const int model = params.model, walls = problem.heading.looksAlong() ? 2 : 1;
        std::vector<WeighedHypothesis> all(1, WeighedHypothesis(MotionHypothesis(MODEL_NONE, 0), prior.logRest()));
        if (model != MODEL_NONE && model != MODEL_1LA)
        {
            const int motion = model == MODEL_3LA ? MODEL_3LA : MODEL_4LA;
            all.push_back(WeighedHypothesis(MotionHypothesis(motion, walls), std::log(1 - 2 * UNUSUAL)));
            if (walls == 2) // or one, on either side
                all.push_back(WeighedHypothesis(MotionHypothesis(motion, 1), std::log(UNUSUAL / 2)));
        }
        if (model == MODEL_AUTO || model == MODEL_1LA)
            all.push_back(WeighedHypothesis(MotionHypothesis(MODEL_1LA, 0),
                                            std::log(model == MODEL_AUTO ? UNUSUAL / 2 : 1 - UNUSUAL / 2)));
        return all;
    }

    // Without a motion only tilts can explain what leans: three points of each normal distribution.
    std::vector<Fit> startsAtRest() const
    {
        const double points[] = {0, std::sqrt(3.), -std::sqrt(3.)};
        const Heading& heading = problem.heading;
        std::vector<Fit> starts;
        for (const double roll : points)
            for (const double pitch : points)
            {
                Fit fit(MotionHypothesis(MODEL_NONE, 0));
                fit.model[P_STREET] = heading.angle;
                // About the vehicle's axes.
                const double r = roll * problem.gravitySigma, p = pitch * problem.vehiclePitchSigma;
                fit.model[P_ROLL] = heading.c * r + heading.s * p;
                fit.model[P_PITCH] = heading.c * p - heading.s * r;
                starts.push_back(fit);
                if (!(problem.gravitySigma > 0))
                    return starts;
            }
        return starts;
    }

    // The expected motion, a consensus of the verticals, and a pure rotation.
    std::vector<Model> starts(const MotionHypothesis& hypothesis) const
    {
        std::vector<Model> models;
        Model m;
        m[P_STREET] = problem.heading.angle;
        Model consensus;
        if (findConsensus(hypothesis, consensus))
            models.push_back(consensus);
        if (!hypothesis.translates())
        {
            m[P_ALPHA] = medianAlpha();
            models.push_back(m);
            m[P_ALPHA] = prior.expectedAlpha();
            if (prior.yawRateIsGiven())
                models.push_back(m);
            return models;
        }
        m[P_ALPHA] = hypothesis.turns() ? prior.expectedAlpha() : 0;
        m[P_LAMBDA] = hypothesis.walls == 2 ? 1 : 0;
        const double factors[] = {0.5, 2};
        for (int direction = 1; direction >= -1; direction -= 2)
            for (int i = 0; i < 2; i++)
            {
                if (prior.givenDirection() != 0 && direction != prior.givenDirection())
                    continue;
                const double speed = direction * factors[i] * prior.expectedScaledSpeed();
                m[P_B] = speed * problem.heading.c;
                m[P_D] = speed * problem.heading.s;
                m.direction = direction;
                // The only wall is on the side on which the verticals are.
                const double column = problem.verticals[problem.verticals.size() / 2].u[0];
                if (hypothesis.walls == 1 && direction * (m[P_D] - m[P_B] * column) < 0)
                {
                    m[P_B] *= -1;
                    m[P_D] *= -1;
                }
                models.push_back(m);
            }
        if (hypothesis.turns())
        {
            models.push_back(models.back());
            models.back()[P_ALPHA] = medianAlpha();
        }
        return models;
    }

    bool findConsensus(const MotionHypothesis& hypothesis, Model& model) const
    {
        RansacOptions options;
        options.confidence = params.confidence;
        options.maxIterations = params.maxIterations;
        options.seed = (uint64)params.seed;
        CandidateConsensus consensus(problem, hypothesis, params.threshold);
        double score;
        return loRansac(consensus, options, model, score);
    }

    // The motion without translation that half of the candidates exceed: one segment tells it (doc/theory.md,
    // "Solvers", 1-LA).
    double medianAlpha() const
    {
        std::vector<double> alphas;
        for (size_t i = 0; i < problem.verticals.size(); i++)
        {
            const UprightSegment& c = problem.verticals[i];
            alphas.push_back(0.5 * (std::atan(c.v[0]) - std::atan(c.u[0])) / (c.timeU - c.timeV));
        }
        const double limit = 0.9 * problem.limits.maxAlpha;
        return std::min(std::max(medianOf(alphas.begin(), alphas.end()), -limit), limit);
    }

    // Each start, and another one from there in the direction of the street.
    std::vector<Fit> allowedStarts(const MotionHypothesis& hypothesis) const
    {
        const int ways = 2;
        const std::vector<Model> models = starts(hypothesis);
        std::vector<Fit> allowed;
        for (size_t i = 0; i < ways * models.size(); i++)
        {
            Fit fit(hypothesis);
            fit.model = models[i / ways];
            if ((i % ways == 0 || startFromStreetDirection(problem, hypothesis, fit.model)) &&
                isAllowed(problem, hypothesis, fit.model))
                allowed.push_back(fit);
        }
        return allowed;
    }

    static const Fit& leastOf(const std::vector<WeighedHypothesis>& all)
    {
        const Fit* least = &cheapest(all[0].minima);
        for (const WeighedHypothesis& h : all)
            if (!h.minima.empty() && cheapest(h.minima).cost < least->cost)
                least = &cheapest(h.minima);
        return *least;
    }

    // Noise and fits, in turn; then by how much the evidence says less than its number.
    void measureNoise(std::vector<WeighedHypothesis>& all)
    {
        const int passes = problem.noiseIsKnown ? 1 : 3;
        for (int pass = 0; pass < passes; pass++)
        {
            setNoise(leastOf(all));
            refineAll(all);
        }
        problem.noiseIsKnown = true;
        problem.verticalWeight = 1 / dependence;
        problem.otherWeight = problem.verticalWeight / DEPENDENCE_OF_OTHERS;
        ownNoise = ownNoiseOf(leastOf(all));
        refineAll(all);
    }

    void setNoise(const Fit& fit)
    {
        const Slants slants = slantsOf(problem, fit.model, fit.hypothesis.translates());
        noise = fitSlantNoise(slants, problem.focal);
        problem.sigma = noise.pixels;
        problem.lean = noise.lean;
        problem.lossScale = noise.lossScale(slants, problem.focal);
        problem.weigh();
    }

    // The first minimum of each hypothesis says which others are worth their steps.
    void refineAll(std::vector<WeighedHypothesis>& all) const
    {
        std::vector<Fit*> firsts;
        std::vector<std::pair<Fit*, const Fit*>> others;
        for (WeighedHypothesis& h : all)
            for (size_t i = 0; i < h.minima.size(); i++)
                if (i == 0)
                    firsts.push_back(&h.minima[i]);
                else
                    others.push_back(std::make_pair(&h.minima[i], &h.minima[0]));
        forEachInParallel(int(firsts.size()), [&](int i) { firsts[i]->refine(problem); });
        forEachInParallel(int(others.size()),
                          [&](int i) { others[i].first->refine(problem, others[i].second->cost + tooFar()); });
        for (WeighedHypothesis& h : all)
            h.keepDistinct(tooFar());
    }

    // By so much a cost is above another one whose motion makes that of the former negligible.
    double tooFar() const { return -2 * std::log(NEGLIGIBLE) * dependence; }

    // By how much the logarithm of a fit's likelihood with the noise that suits it best is above that of the
    // refinement.
    double ownNoiseOf(const Fit& fit) const
    {
        const Slants slants = slantsOf(problem, fit.model, fit.hypothesis.translates());
        return ownNoiseOf(slants);
    }

    double ownNoiseOf(const Slants& slants) const
    {
        return fitSlantNoise(slants, problem.focal, &noise).logLikelihood + costOf(slants) / 2;
    }

    // That of the verticals in the refinement, as if they erred independently.
    double costOf(const Slants& slants) const
    {
        double cost = 0;
        for (size_t i = 0; i < slants.size(); i++)
        {
            const double error = problem.sigma / (problem.focal * slants.length[i]);
            const double r2 = slants.slant[i] * slants.slant[i] / (problem.lean * problem.lean + error * error),
                         s2 = problem.lossScale * problem.lossScale;
            cost += r2 * s2 / (r2 + s2);
        }
        return cost;
    }

    // As the best of the motions along walls shows it.
    RoadLimit roadLimit(const std::vector<WeighedHypothesis>& all) const
    {
        Fit best = Fit(MotionHypothesis(MODEL_NONE, 0));
        for (const WeighedHypothesis& h : all)
            if (h.hypothesis.translates() && !h.minima.empty() && cheapest(h.minima).cost < best.cost)
                best = cheapest(h.minima);
        if (!(best.cost < DBL_MAX))
            return RoadLimit();
        RoadLimit limit = findRoadLimit(problem, best.model, params.threshold);
        if (prior.roadIsSought() || prior.wallIsGiven())
            limit.addContacts();
        return limit;
    }

    // Each hypothesis may have its own noise: a motion that explains the noise of another one must not be paid twice.
    double logNoise(const Fit& fit) const { return (ownNoiseOf(fit) - ownNoise) / dependence; }

    // Fits of a camera at rest differ in tilts of one normal distribution: together they would count twice.
    void keepMostProbable(std::vector<Fit>& ofRest) const
    {
        const Fit best = *std::max_element(ofRest.begin(), ofRest.end(), [&](const Fit& a, const Fit& b) {
            return logWeight(a, 0) < logWeight(b, 0);
        });
        ofRest.assign(1, best);
    }

    // A lens that isn't known bends verticals as a motion can: those of a camera at rest may be seen through any lens.
    void addRestThroughOtherLenses(const WeighedHypothesis& known)
    {
        const int count = int(sizeof(OTHER_LENSES) / sizeof(*OTHER_LENSES));
        std::vector<Fit> fits(count, Fit(known.hypothesis));
        double logWeights[count];
        forEachInParallel(count, [&](int i) {
            logWeights[i] = -DBL_MAX;
            WeighedHypothesis rest(known.hypothesis, known.logPrior);
            RefinementProblem other = problem;
            double logJacobian;
            if (!seeThroughOtherLens(OTHER_LENSES[i] * problem.distortionSigma, other, logJacobian))
                return;
            other.weigh();
            rest.minima = startsAtRest();
            for (Fit& fit : rest.minima)
                fit.refine(other);
            rest.keepDistinct(tooFar());
            for (const Fit& fit : rest.minima)
            {
                const double likelihood = ownNoiseOf(slantsOf(other, fit.model, false)) + logJacobian,
                             logWeight = logEvidence(problem, fit) + (likelihood - ownNoise) / dependence +
                                         rest.logPrior - OTHER_LENSES[i] * OTHER_LENSES[i] / 2;
                if (logWeight > logWeights[i])
                {
                    logWeights[i] = logWeight;
                    fits[i] = fit;
                }
            }
        });
        for (int i = 0; i < count; i++)
            mixture.add(fits[i], logWeights[i]);
    }

    // A scene in which nothing is vertical, or on no two walls, shows nothing of the motion: it is what is known
    // without the image, as far as the requested model has it. Other segments are as with a camera at rest.
    void addSceneWithoutVerticals(const Fit& rest)
    {
        Model turning;
        turning[P_ALPHA] = prior.expectedAlpha();
        turning[P_STREET] = problem.heading.angle;
        const Slants slants = slantsOf(problem, turning, false), ofRest = slantsOf(problem, rest.model, false);
        // A car's image shows a street, all the more if somebody measures how it drives.
        const double tilts = problem.gravitySigma * problem.vehiclePitchSigma,
                     otherCost = rest.cost - costOf(ofRest) / dependence,
                     probability = UNUSUAL / 2 * std::pow(2 * UNUSUAL, prior.givenShare());
        const double logWeight = std::log(probability * tilts) - otherCost / 2 +
                                 (logLikelihoodWithoutVerticals(slants) - ownNoise) / dependence;
        // What is given is a reason to correct, what is usual isn't.
        const int given = prior.givenDirection();
        addUnseenMotion(unseenHypothesis(prior.yawRateIsGiven(), given != 0), given, logWeight, TO_DECIDE);
        const MotionHypothesis moving = unseenHypothesis(true, true);
        const double logMoves = logWeight - std::log1p(std::exp(prior.logRest()));
        addUnseenMotion(unseenHypothesis(false, false), 0, logMoves + prior.logRest(), TO_EXPECT);
        for (int direction = 1; direction >= -1; direction -= 2)
            addUnseenMotion(moving, direction, logMoves - prior.directionPenalty(direction, moving) / 2, TO_EXPECT);
    }

    MotionHypothesis unseenHypothesis(bool turns, bool translates) const
    {
        turns &= params.model != MODEL_NONE && params.model != MODEL_3LA;
        translates &= params.model != MODEL_NONE && params.model != MODEL_1LA;
        const int walls = !translates ? 0 : problem.heading.looksAlong() ? 2 : 1;
        return MotionHypothesis(translates ? (turns ? MODEL_4LA : MODEL_3LA) : (turns ? MODEL_1LA : MODEL_NONE), walls);
    }

    void addUnseenMotion(const MotionHypothesis& hypothesis, int direction, double logWeight, MotionUse use)
    {
        Fit unseen(hypothesis);
        unseen.model = prior.expectedMotion(hypothesis, direction, unseen.covariance);
        // The points of a normal distribution of alpha that have its variance.
        const double step = std::sqrt(3 * unseen.covariance(P_ALPHA, P_ALPHA)), middle = unseen.model[P_ALPHA];
        unseen.covariance(P_ALPHA, P_ALPHA) = 0;
        for (int i = -1; i <= 1; i++)
        {
            unseen.model[P_ALPHA] = middle + i * step;
            mixture.add(unseen, logWeight + std::log(i == 0 ? 2. / 3 : 1. / 6), use);
        }
    }

    double logWeight(const Fit& fit, double logPrior) const
    {
        return logEvidence(problem, fit) + logNoise(fit) + logPrior;
    }

    // Each minimum is swept over the yaw rate, if it has one and isn't improbable against the others.
    void addAll(const std::vector<WeighedHypothesis>& all)
    {
        const int count = int(all.size());
        std::vector<std::vector<double>> logWeights(all.size()); // of the minima
        forEachInParallel(count, [&](int i) {
            for (const Fit& fit : all[i].minima)
                logWeights[i].push_back(logWeight(fit, all[i].logPrior));
        });
        double least = mixture.logSum();
        for (const std::vector<double>& ofHypothesis : logWeights)
            for (const double weight : ofHypothesis)
                least = std::max(least, weight);
        least += 2 * std::log(NEGLIGIBLE); // a valley may hold more than its bottom says
        std::vector<std::vector<YawSweep>> valleys(all.size());
        forEachInParallel(count, [&](int i) {
            for (size_t k = 0; k < logWeights[i].size() && all[i].hypothesis.turns(); k++)
                if (logWeights[i][k] > least && !contain(valleys[i], all[i].minima[k]))
                    valleys[i].push_back(YawSweep(problem, all[i].minima[k], valleys[i]));
        });
        for (int i = 0; i < count; i++)
        {
            for (const YawSweep& valley : valleys[i])
            {
                const double logShared = all[i].logPrior + logNoise(cheapest(valley.fits));
                for (size_t k = 0; k < valley.fits.size(); k++)
                    mixture.add(valley.fits[k], valley.logMasses[k] + logShared);
            }
            for (size_t k = 0; k < logWeights[i].size() && !all[i].hypothesis.turns(); k++)
            {
                Fit fit = all[i].minima[k];
                integratePeak(problem, fit);
                mixture.add(fit, logWeights[i][k]);
            }
        }
    }

    RefinementProblem& problem;
    const AckermannEstimator::Params& params;
    const DrivingPrior& prior;
    MotionMixture mixture;
    SlantNoise noise = SlantNoise(); // of the best fit
    double dependence = 1;           // by which the verticals say less than their number
    double ownNoise = 0;             // of the best fit
};

} // namespace

bool explorePosterior(RefinementProblem& problem, const AckermannEstimator::Params& params,
                      const DisplacementField& field, Posterior& result)
{
    return Explorer(problem, params, field).run(result);
}

}} // namespace cv::rsackermann
