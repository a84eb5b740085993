// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "consensus.hpp"
#include "lo_ransac.hpp"
#include "motion_mixture.hpp"
#include "road_contact.hpp"
#include "slant_noise.hpp"
#include "street_direction.hpp"
#include "uncertainty.hpp"

namespace cv { namespace rsackermann {

// doc/theory.md, "Evidence" and "Posterior", have the reasons.
static const int CONSENSUS_ITERATIONS = 500;  // it is one start of several
static const double LOSS_SCALE = 2;           // in scales of the slants
static const double DEPENDENCE_OF_OTHERS = 3; // over that of the verticals
static const double ROTATION_PRIOR = 0.05;    // of the probability that a motion has
static const double WALLS_PRIOR = 0.7;
static const double ONE_WALL_PRIOR = 0.1; // of a street that is open to one side
static const double OPEN_SIDE = 0.2;      // part of the verticals that are seen there, at most
static const double SAME_LEAN = 1.3;      // ratio below which the noise counts as unchanged
static const double FIRST_STEP = 0.7;     // of the sweep over the yaw rate, in sigmas
static const double STEP_GROWTH = 1.25;
static const double IMPROBABLE = 7; // logarithm of a density below the highest one

namespace {

// A motion hypothesis with the logarithm of its prior probability, given that the camera moves.
struct WeighedHypothesis
{
    MotionHypothesis hypothesis;
    double logPrior;

    WeighedHypothesis(const MotionHypothesis& h, double prior) : hypothesis(h), logPrior(std::log(prior)) {}
};

class Explorer
{
public:
    Explorer(RefinementProblem& problem_, const AckermannEstimator::Params& params_, const DisplacementField& field)
        : problem(problem_), params(params_), usual(*problem_.usual), mixture(field, usual)
    {
    }

    bool run(Posterior& result)
    {
        problem.lossScale = LOSS_SCALE;
        problem.lean = 0;
        problem.weigh();
        const std::vector<WeighedHypothesis> all = hypotheses();
        std::vector<Fit> fits;
        size_t best = 0;
        for (size_t i = 0; i < all.size(); i++)
        {
            fits.push_back(bestFit(all[i].hypothesis));
            best = fits[i].cost < fits[best].cost ? i : best;
        }
        if (!(fits[best].cost < DBL_MAX))
            return false;
        measureNoise(fits, best);
        mixture.setRoadContact(roadContact(fits));
        addRest();
        for (size_t i = 0; i < all.size(); i++)
            if (fits[i].cost < DBL_MAX)
                sweep(fits[i], all[i].logPrior);
        result = mixture.best();
        return true;
    }

private:
    std::vector<WeighedHypothesis> hypotheses() const
    {
        const bool isAhead = problem.heading.looksAlong();
        std::vector<WeighedHypothesis> all;
        all.push_back(WeighedHypothesis(MotionHypothesis(MODEL_1LA, 0), ROTATION_PRIOR));
        all.push_back(WeighedHypothesis(MotionHypothesis(MODEL_4LA, isAhead ? 2 : 1), WALLS_PRIOR));
        // One wall shows three numbers for five unknowns (doc/theory.md, "Roll and yaw rate"): too few if no motion is
        // told.
        if (isAhead && usual.motionIsTold() && isOpenToOneSide())
            all.push_back(WeighedHypothesis(MotionHypothesis(MODEL_4LA, 1), ONE_WALL_PRIOR));
        return all;
    }

    bool isOpenToOneSide() const
    {
        const double ahead = std::tan(problem.heading.angle);
        size_t right = 0;
        for (size_t i = 0; i < problem.verticals.size(); i++)
            right += problem.verticals[i].u[0] + problem.verticals[i].v[0] > 2 * ahead;
        return std::min(right, problem.verticals.size() - right) <= OPEN_SIDE * problem.verticals.size();
    }

    // The usual motion, a consensus of the verticals, and a pure rotation.
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
            m[P_ALPHA] = usual.yawRateIsTold() ? usual.toldAlpha() : medianAlpha();
            models.push_back(m);
            return models;
        }
        m[P_ALPHA] = usual.toldAlpha();
        m[P_LAMBDA] = hypothesis.walls == 2 ? 1 : 0;
        const double factors[] = {0.5, 2};
        for (int direction = 1; direction >= -1; direction -= 2)
            for (int i = 0; i < 2; i++)
            {
                // One start is enough for a rare direction.
                if ((usual.toldDirection() != 0 && direction != usual.toldDirection()) ||
                    (direction < 0 && usual.toldDirection() == 0 && i != 1))
                    continue;
                const double speed = direction * factors[i] * usual.usualScaledSpeed(direction);
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
        if (!usual.yawRateIsTold())
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
        options.maxIterations = std::min(params.maxIterations, CONSENSUS_ITERATIONS);
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
        std::nth_element(alphas.begin(), alphas.begin() + alphas.size() / 2, alphas.end());
        const double limit = 0.9 * problem.limits.maxAlpha;
        return std::min(std::max(alphas[alphas.size() / 2], -limit), limit);
    }

    bool isAllowed(const MotionHypothesis& hypothesis, const Model& model) const
    {
        return problem.limits.allow(model) && wallsAreSeen(problem, hypothesis, model);
    }

    Fit bestFit(const MotionHypothesis& hypothesis) const
    {
        Fit best(hypothesis);
        const std::vector<Model> models = starts(hypothesis);
        for (size_t i = 0; i < models.size(); i++)
        {
            Model start = models[i];
            for (int pass = 0; pass < 2; pass++)
            {
                if (pass > 0 && !startFromStreetDirection(problem, hypothesis, start))
                    break;
                if (!isAllowed(hypothesis, start))
                    continue;
                const Fit fit = refineFrom(problem, start, hypothesis);
                if (fit.cost < best.cost)
                    best = fit;
            }
        }
        return best;
    }

    // Noise and fits, in turn, until the noise stays about the same; then by how much the evidence says less than its
    // number.
    void measureNoise(std::vector<Fit>& fits, size_t best)
    {
        const int passes = 3;
        for (int pass = 0; pass < passes; pass++)
        {
            const double before = problem.lean;
            setNoise(fits[best]);
            refineAll(fits);
            if (problem.lean < SAME_LEAN * before && before < SAME_LEAN * problem.lean)
                break;
        }
        const Slants slants(problem, fits[best].model, fits[best].hypothesis.translates());
        double neighbours;
        const double measured = dependenceOf(slants, noise, problem.focal, neighbours);
        dependence = std::max(measured, hiddenDependence(problem, noise, neighbours));
        problem.verticalWeight = 1 / dependence;
        problem.otherWeight = problem.verticalWeight / DEPENDENCE_OF_OTHERS;
        ownNoise = ownNoiseOf(fits[best]);
        refineAll(fits);
    }

    void setNoise(const Fit& fit)
    {
        noise = fitSlantNoise(Slants(problem, fit.model, fit.hypothesis.translates()), problem.focal);
        problem.sigma = noise.pixels;
        problem.lean = noise.lean;
        problem.weigh();
    }

    void refineAll(std::vector<Fit>& fits) const
    {
        for (size_t i = 0; i < fits.size(); i++)
            if (fits[i].cost < DBL_MAX)
                refineAgain(problem, fits[i]);
    }

    // By how much the logarithm of a fit's likelihood with the noise that suits it best is above that of the
    // refinement.
    double ownNoiseOf(const Fit& fit) const
    {
        const Slants slants(problem, fit.model, fit.hypothesis.translates());
        double cost = 0;
        for (size_t i = 0; i < slants.size(); i++)
        {
            const double error = problem.sigma / (problem.focal * slants.length[i]);
            const double r2 = slants.slant[i] * slants.slant[i] / (problem.lean * problem.lean + error * error),
                         s2 = LOSS_SCALE * LOSS_SCALE;
            cost += r2 * s2 / (r2 + s2);
        }
        return fitSlantNoise(slants, problem.focal).logLikelihood + cost / 2;
    }

    // Laplace's approximation of the contribution of a fit at one yaw rate.
    double logEvidence(const Fit& fit, const MotionHypothesis& hypothesis) const
    {
        double volume = logVolume(fit) - usual.logVolume(hypothesis);
        // In the logarithms of the wall's scaled speed and of the ratio, and in the azimuth.
        if (hypothesis.translates())
            volume -= 2 * std::log(std::hypot(fit.model[P_B], fit.model[P_D]));
        if (hypothesis.walls == 2)
            volume -= std::log(fit.model[P_LAMBDA]);
        return volume - fit.cost / 2;
    }

    // As the best of the motions along walls shows it.
    RoadContact roadContact(const std::vector<Fit>& fits) const
    {
        const Fit* best = 0;
        for (size_t i = 0; i < fits.size(); i++)
            if (fits[i].hypothesis.translates() && fits[i].cost < (best ? best->cost : DBL_MAX))
                best = &fits[i];
        return best ? findRoadContact(problem, best->model, best->covariance, params.threshold) : RoadContact();
    }

    // Each hypothesis may have its own noise: a motion that explains the noise of another one must not be paid twice.
    double logNoise(const Fit& fit) const { return (ownNoiseOf(fit) - ownNoise) / dependence; }

    void addRest()
    {
        const MotionHypothesis none(MODEL_NONE, 0);
        Model still;
        still[P_STREET] = problem.heading.angle;
        const Fit fit = refineFrom(problem, still, none);
        mixture.add(fit, none, logEvidence(fit, none) + logNoise(fit) + usual.logRest());
    }

    // Adds motions with the yaw rates to both sides of a fit, until they are improbable.
    void sweep(const Fit& fit, double logPrior)
    {
        const MotionHypothesis pinned(fit.hypothesis.translates() ? MODEL_3LA : MODEL_NONE, fit.hypothesis.walls);
        const double variance = fit.covariance(P_ALPHA, P_ALPHA),
                     sigma = variance > 0 ? std::sqrt(variance) : usual.alphaScale();
        const double first = std::min(FIRST_STEP * sigma, 0.5 * usual.alphaScale());
        const double logWeight = logPrior + logNoise(fit);
        Fit middle(pinned);
        middle.model = fit.model;
        double highest = addPinned(fit.hypothesis, first, logWeight, middle);
        for (int side = -1; side <= 1; side += 2)
        {
            Fit last = middle;
            for (double step = first, offset = first; offset < 2 * problem.limits.maxAlpha;
                 step *= STEP_GROWTH, offset += step)
            {
                Model next = last.model;
                for (int i = 0; i < PARAMETERS && variance > 0; i++)
                    next.value[i] += side * step * fit.covariance(i, P_ALPHA) / variance;
                if (!isAllowed(fit.hypothesis, next))
                    next = last.model;
                next[P_ALPHA] = fit.model[P_ALPHA] + side * offset;
                if (!problem.limits.allow(next))
                    break;
                last.model = next;
                const double added = addPinned(fit.hypothesis, (1 + STEP_GROWTH) / 2 * step, logWeight, last);
                highest = std::max(highest, added);
                if (added < highest - IMPROBABLE)
                    break;
            }
        }
    }

    // Refines and adds the motion at the yaw rate of a fit. Returns the logarithm of its density.
    double addPinned(const MotionHypothesis& hypothesis, double width, double logWeight, Fit& fit)
    {
        const int iterations = 8;
        fit.cost = refine(problem, fit.hypothesis, ALL_SEGMENTS, iterations, fit.model, &fit.covariance);
        const double density = logWeight + logEvidence(fit, hypothesis) + usual.logYawDensity(fit.model[P_ALPHA]);
        mixture.add(fit, hypothesis, density + std::log(width));
        return density;
    }

    RefinementProblem& problem;
    const AckermannEstimator::Params& params;
    const UsualDrive& usual;
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
