// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "drive_fit.hpp"
#include "drive_terms.hpp"
#include <Eigen/Cholesky>

namespace cv { namespace rsackermann {

static const int ITERATIONS = 6; // at each scale

namespace {

typedef Eigen::Matrix<double, FLOW_VALUES, 1> Unknowns;
typedef Eigen::Matrix<double, FLOW_VALUES, FLOW_VALUES> Information;
typedef Eigen::Matrix<double, FLOW_VALUES, 2> FlowGradient;

struct Minimum
{
    Unknowns at;
    Information information;
    double cost;
};

class DriveProblem
{
public:
    DriveProblem(const RollingShutterCamera& camera, const std::vector<Sight>& sights_,
                 const std::vector<UprightSegment>& verticals_, const DriveState& prediction)
        : sights(sights_), residual(camera), verticals(verticals_), heading(camera.heading),
          unit(camera.secondsPerUnitTime()), focal(camera.cameraMatrix(0, 0))
    {
        Matx<double, FLOW_VALUES, FLOW_VALUES> covariance =
            Matx<double, FLOW_VALUES, FLOW_VALUES>::eye() * (TURN_SIGMA * TURN_SIGMA);
        covariance(FLOW_YAW_CHANGE, FLOW_YAW_CHANGE) = YAW_CHANGE_SIGMA * YAW_CHANGE_SIGMA;
        expected.setZero();
        for (int i = 0; i < DRIVE_VALUES; i++)
        {
            expected[i] = prediction.value[i];
            for (int j = 0; j < DRIVE_VALUES; j++)
                covariance(i, j) = prediction.covariance(i, j);
        }
        prior = Eigen::Map<Information>(covariance.val).llt().solve(Information::Identity());
    }

    // Levenberg-Marquardt's cost, with the points' loss of a scale in sigmas.
    double cost(const Unknowns& u, double scale) const
    {
        return pointCost(u, scale) + slantCost(u) + (u - expected).dot(prior * (u - expected));
    }

    double pointCost(const Unknowns& u, double scale) const
    {
        double sum = 0;
        for (size_t i = 0; i < sights.size(); i++)
        {
            const Point2d r = residual.evaluate(sights[i], u.data(), 0);
            const double squared = r.dot(r) / (POINT_SIGMA * POINT_SIGMA);
            sum += cauchyLoss(isOfOwnCar(sights[i], squared) ? AGREES * AGREES : squared, scale);
        }
        return sum / POINT_DEPENDENCE;
    }

    // Gauss-Newton with ever less tolerance for points that disagree. Without tolerance from the beginning it finds
    // what is next to the start.
    Minimum refine(const Unknowns& start, bool isTolerant) const
    {
        Minimum m;
        m.at = start;
        for (double scale : {8., 3., 1.})
        {
            if (!isTolerant && scale > 1)
                continue;
            m.cost = cost(m.at, scale);
            for (int k = 0; k < ITERATIONS && step(scale, m); k++)
                ;
        }
        return m;
    }

    const std::vector<Sight>& sights;
    const FlowResidual residual;

private:
    // Returns whether there is more to be gained.
    bool step(double scale, Minimum& m) const
    {
        const double enough = 1e-3;
        const int halvings = 4;
        Unknowns gradient = prior * (m.at - expected);
        m.information = prior;
        addPoints(m.at, scale, m.information, gradient);
        addVerticals(m.at, m.information, gradient);
        Unknowns change = m.information.selfadjointView<Eigen::Lower>().llt().solve(gradient);
        for (int half = 0; half < halvings; half++, change *= 0.5)
        {
            Unknowns next = m.at - change;
            for (int i = DRIVE_LEFT; i <= DRIVE_ROAD; i++)
                next[i] = std::max(next[i], 0.);
            const double after = cost(next, scale);
            if (!(after < m.cost))
                continue;
            const bool isMore = m.cost - after > enough;
            m.at = next;
            m.cost = after;
            return isMore;
        }
        return false;
    }

    void addPoints(const Unknowns& u, double scale, Information& information, Unknowns& gradient) const
    {
        for (size_t i = 0; i < sights.size(); i++)
        {
            double jacobian[2][FLOW_VALUES];
            const Point2d r = residual.evaluate(sights[i], u.data(), jacobian);
            const double variance = POINT_SIGMA * POINT_SIGMA, squared = r.dot(r) / variance;
            if (FlowResidual::isBehind(r) || isOfOwnCar(sights[i], squared))
                continue;
            const double weight = cauchyWeight(squared, scale) / variance / POINT_DEPENDENCE;
            const Eigen::Map<const FlowGradient> J(jacobian[0]);
            information.selfadjointView<Eigen::Lower>().rankUpdate(J, weight);
            gradient += weight * (J * Eigen::Vector2d(r.x, r.y));
        }
    }

    double slantCost(const Unknowns& u) const
    {
        const PreparedModel model(toModel(DriveVector(u.data()), unit, 0), heading);
        double sum = 0;
        for (size_t i = 0; i < verticals.size(); i++)
        {
            const double r = slantInSigmas(verticals[i], model, focal, 0);
            sum += cauchyLoss(r * r, SLANT_SCALE);
        }
        return sum / SLANT_DEPENDENCE;
    }

    void addVerticals(const Unknowns& u, Information& information, Unknowns& gradient) const
    {
        Matx<double, PARAMETERS, DRIVE_VALUES> byValues;
        const PreparedModel model(toModel(DriveVector(u.data()), unit, &byValues), heading);
        // Summed in the parameters of a model first, of which there are fewer.
        Matx<double, PARAMETERS, PARAMETERS> squares;
        Vec<double, PARAMETERS> products, jacobian;
        for (size_t i = 0; i < verticals.size(); i++)
        {
            const double r = slantInSigmas(verticals[i], model, focal, jacobian.val),
                         weight = cauchyWeight(r * r, SLANT_SCALE) / SLANT_DEPENDENCE;
            squares += weight * (jacobian * jacobian.t());
            products += weight * r * jacobian;
        }
        const DriveMatrix added = byValues.t() * squares * byValues;
        const DriveVector slope = byValues.t() * products;
        for (int i = 0; i < DRIVE_VALUES; i++)
        {
            gradient[i] += slope[i];
            for (int j = 0; j < DRIVE_VALUES; j++)
                information(i, j) += added(i, j);
        }
    }

    const std::vector<UprightSegment>& verticals;
    Heading heading;
    double unit, focal;
    Unknowns expected;
    Information prior;
};

// The share of the displacement that is left, as the points show it; those that don't move with the scene don't count.
// Returns the share of all points that agree.
double expect(const DriveProblem& problem, const Unknowns& u, double focal, DriveFit& fit)
{
    size_t count = 0, others = 0;
    double displacement = 0, missed = 0;
    for (size_t i = 0; i < problem.sights.size(); i++)
    {
        const Sight& s = problem.sights[i];
        const double left = norm(problem.residual.evaluate(s, u.data(), 0));
        if (!(left < AGREES * POINT_SIGMA))
        {
            others += !s.isStill; // what stands still is of the car itself
            continue;
        }
        count++;
        displacement += FlowResidual::shutterPart(s) * focal * norm(s.now - s.other);
        missed += FlowResidual::shutterPart(s) * left;
    }
    fit.agreeing = count > 0 ? double(count) / double(count + others) : 0;
    fit.left = displacement > 0 ? missed / displacement : 1;
    // A motion has to explain more than its unknowns would by chance.
    const int unknowns = 6;
    Unknowns still = u;
    still[DRIVE_YAW_RATE] = still[DRIVE_SPEED] = 0;
    fit.moves = problem.pointCost(still, 1) - problem.pointCost(u, 1) > 2 * unknowns;
    return problem.sights.empty() ? 0 : double(count) / double(problem.sights.size());
}

} // namespace

DriveFit fitDrive(const RollingShutterCamera& camera, const std::vector<Sight>& sights,
                  const std::vector<UprightSegment>& verticals, const DriveState& prediction, bool isVague)
{
    const double enough = 0.5; // of the points agree
    const DriveProblem problem(camera, sights, verticals, prediction);
    DriveFit fit(prediction);
    Unknowns u = Unknowns::Zero();
    for (int i = 0; i < DRIVE_VALUES; i++)
        u[i] = prediction.value[i];
    Minimum best = problem.refine(u, true);
    if (!isVague)
    {
        // What doesn't move with the scene may lead astray from where it was.
        const Minimum nearby = problem.refine(u, false);
        if (nearby.cost < best.cost)
            best = nearby;
    }
    const double share = expect(problem, best.at, camera.cameraMatrix(0, 0), fit);
    if (isVague || share < enough)
    {
        const double speeds[] = {0, 10, 10, -3}, walls[] = {0.1, 0.2, 0.08, 0.1}; // m/s, 1/m
        for (int i = 0; i < 4; i++)
        {
            Unknowns start = u;
            start[DRIVE_SPEED] = speeds[i];
            start[DRIVE_LEFT] = start[DRIVE_RIGHT] = walls[i];
            const Minimum other = problem.refine(start, true);
            if (other.cost < best.cost)
                best = other;
        }
        expect(problem, best.at, camera.cameraMatrix(0, 0), fit);
    }
    std::copy(best.at.data(), best.at.data() + FLOW_VALUES, fit.values);
    const Information covariance =
        best.information.selfadjointView<Eigen::Lower>().llt().solve(Information::Identity());
    for (int i = 0; i < DRIVE_VALUES; i++)
    {
        fit.state.value[i] = best.at[i];
        for (int j = 0; j < DRIVE_VALUES; j++)
            fit.state.covariance(i, j) = covariance(i, j);
    }
    return fit;
}

}} // namespace cv::rsackermann
