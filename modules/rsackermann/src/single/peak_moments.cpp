// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "peak_moments.hpp"
#include <Eigen/Eigenvalues>

namespace cv { namespace rsackermann {

namespace {

// A step of all parameters, or their covariance, with the coordinates of Walls in the places of B, D and lambda.
typedef Eigen::Matrix<double, PARAMETERS, 1> Step;
typedef Eigen::Matrix<double, PARAMETERS, PARAMETERS, Eigen::RowMajor> Covariance;

// Walls by their azimuth and the logarithms of the scaled inverse depths at the middle of their verticals, which hardly
// depend on each other.
class Walls
{
public:
    Walls(const RefinementProblem& problem, const Model& model) : columns(0, 0)
    {
        Vec2d sums, counts;
        for (const UprightSegment& s : problem.verticals)
        {
            const double column = (s.u[0] + s.v[0]) / 2;
            const int side = inverseDepth(model, column) * model.direction > 0 ? 0 : 1;
            sums[side] += column;
            counts[side]++;
        }
        for (int side = 0; side < 2; side++)
            columns[side] = counts[side] > 0 ? sums[side] / counts[side] : sums[1 - side] / counts[1 - side];
    }

    // Of azimuth and logarithms by B, D and lambda.
    Matx33d derivatives(const Model& m) const
    {
        const double B = m[P_B], D = m[P_D], square = B * B + D * D, lambda = m[P_LAMBDA];
        if (square == 0)
            return Matx33d::eye();
        const double left = 1 / inverseDepth(m, columns[0]), right = lambda > 0 ? 1 / inverseDepth(m, columns[1]) : 0;
        return Matx33d(-D / square, B / square, 0, -columns[0] * left, left, 0, -columns[1] * right, right,
                       lambda > 0 ? 1 / lambda : 1);
    }

    // Returns false if a wall is no longer where its verticals are.
    bool move(const Step& step, Model& m) const
    {
        const Model from = m;
        const double c = std::cos(step[P_B]), s = std::sin(step[P_B]);
        if (from[P_B] == 0 && from[P_D] == 0)
            return true;
        m[P_B] = c * from[P_B] - s * from[P_D];
        m[P_D] = s * from[P_B] + c * from[P_D];
        Vec2d nearer;
        for (int side = 0; side < 2; side++)
            nearer[side] = inverseDepth(from, columns[side]) / inverseDepth(m, columns[side]);
        m[P_B] *= nearer[0] * std::exp(step[P_D]);
        m[P_D] *= nearer[0] * std::exp(step[P_D]);
        m[P_LAMBDA] *= nearer[1] / nearer[0] * std::exp(step[P_LAMBDA] - step[P_D]);
        return nearer[0] > 0 && nearer[1] > 0;
    }

private:
    static double inverseDepth(const Model& m, double column) { return m[P_D] - m[P_B] * column; }

    Vec2d columns; // of the left (or only) and the right wall
};

bool move(const Walls& walls, const Step& step, Model& m)
{
    for (const Parameter p : {P_ALPHA, P_ROLL, P_PITCH, P_STREET})
        m[p] += step[p];
    return walls.move(step, m);
}

Covariance derivatives(const Walls& walls, const Model& model)
{
    Covariance result = Covariance::Identity();
    result.block<3, 3>(P_B, P_B) =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(walls.derivatives(model).val);
    return result;
}

// Standard deviations of the unknowns that are free, along the principal axes.
std::vector<Step> principalAxes(const Covariance& covariance)
{
    typedef Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, PARAMETERS, PARAMETERS> FreeCovariance;
    int index[PARAMETERS], count = 0;
    for (int i = 0; i < PARAMETERS; i++)
        if (covariance(i, i) > 0)
            index[count++] = i;
    std::vector<Step> axes(count, Step::Zero());
    if (count == 0)
        return axes;
    FreeCovariance free = FreeCovariance::Zero(count, count);
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++)
            free(i, j) = covariance(index[i], index[j]);
    const Eigen::SelfAdjointEigenSolver<FreeCovariance> solver(free);
    for (int k = 0; k < count; k++)
        for (int i = 0; i < count; i++)
            axes[k][index[i]] = std::sqrt(std::max(solver.eigenvalues()[k], 0.)) * solver.eigenvectors()(i, k);
    return axes;
}

// Along an axis, in standard deviations of the normal distribution.
struct Moments
{
    double mean, variance;
};

// By the five points of Gauss and Hermite.
Moments momentsAlong(const RefinementProblem& problem, const Walls& walls, const Fit& fit, const Step& axis)
{
    const double far = std::sqrt(5 + std::sqrt(10.)), near = std::sqrt(5 - std::sqrt(10.)),
                 farShare = (7 - 2 * std::sqrt(10.)) / 60, nearShare = (7 + 2 * std::sqrt(10.)) / 60;
    const double points[] = {near, -near, far, -far}, shares[] = {nearShare, nearShare, farShare, farShare};
    double mass = 8. / 15, first = 0, second = 0;
    for (int i = 0; i < 4; i++)
    {
        const double z = points[i];
        Model model = fit.model;
        if (!move(walls, z * axis, model) || !isAllowed(problem, fit.hypothesis, model))
            return {0, 1}; // a limit says nothing of the shape
        // Over what the normal distribution has there; what costs less than the minimum belongs to another one.
        const double rise = std::max(0., costOf(problem, fit.hypothesis, model) - fit.cost),
                     share = shares[i] * std::exp((z * z - rise) / 2);
        mass += share;
        first += share * z;
        second += share * z * z;
    }
    const double mean = first / mass;
    return {mean, second / mass - mean * mean};
}

} // namespace

void integratePeak(const RefinementProblem& problem, Fit& fit)
{
    if (!(fit.cost < DBL_MAX))
        return;
    const Walls walls(problem, fit.model);
    Eigen::Map<Covariance> ofFit(fit.covariance.val);
    const Covariance toWalls = derivatives(walls, fit.model);
    Covariance covariance = Covariance::Zero();
    Step mean = Step::Zero();
    for (const Step& axis : principalAxes(toWalls * ofFit * toWalls.transpose()))
    {
        const Moments m = momentsAlong(problem, walls, fit, axis);
        mean += m.mean * axis;
        covariance += m.variance * axis * axis.transpose();
    }
    Model middle = fit.model;
    if (!move(walls, mean, middle))
        return;
    fit.model = middle;
    const Covariance fromWalls = derivatives(walls, middle).inverse();
    ofFit = fromWalls * covariance * fromWalls.transpose();
}

}} // namespace cv::rsackermann
