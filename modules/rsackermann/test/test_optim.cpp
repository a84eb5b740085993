// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"

#include "../src/factors/robust_losses.hpp"
#include "../src/optim/levenberg_marquardt.hpp"
#include "../src/optim/normal_equations.hpp"
#include "../src/optim/schur_complement.hpp"
#include <Eigen/Dense>
#include <functional>

namespace opencv_test { namespace {

typedef NormalEquations<Eigen::Dynamic, 4> SmallEquations;
typedef SmallEquations::Vector Unknowns;
typedef std::function<Eigen::VectorXd(const Unknowns&)> Residuals;

struct LeastSquares
{
    double cost(double r2) const { return r2; }
    double slope(double) const { return 1; }
};

// A problem that is nothing but its residuals, with numerical derivatives.
struct MockProblem
{
    typedef Unknowns State;
    typedef Unknowns Step;
    typedef SmallEquations Equations;

    Residuals residuals;
    bool (*limits)(const Unknowns&);
    mutable int evaluations;

    explicit MockProblem(Residuals r)
        : residuals(std::move(r)), limits([](const Unknowns&) { return true; }), evaluations(0)
    {
    }

    void evaluate(const Unknowns& x, SmallEquations& equations) const
    {
        evaluations++;
        const Eigen::VectorXd r = residuals(x);
        Eigen::MatrixXd J(x.size(), r.size());
        for (int i = 0; i < x.size(); i++)
        {
            Unknowns high = x, low = x;
            high[i] += 1e-6;
            low[i] -= 1e-6;
            J.row(i) = (residuals(high) - residuals(low)).transpose() / 2e-6;
        }
        equations = SmallEquations(int(x.size()));
        equations.add(J, r, LeastSquares());
    }
    static Unknowns moved(const Unknowns& x, const Unknowns& step) { return x + step; }
    bool allows(const Unknowns& x) const { return limits(x); }
};

Unknowns vectorOf(std::initializer_list<double> values)
{
    Unknowns v(int(values.size()));
    std::copy(values.begin(), values.end(), v.data());
    return v;
}

Eigen::VectorXd rosenbrock(const Unknowns& x)
{
    return Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]);
}

TEST(RSAckermann_Optim, curved_valley)
{
    const MockProblem problem(rosenbrock);
    Unknowns x = vectorOf({-1.2, 1});
    SmallEquations at;
    const MinimizerStats stats = minimize(problem, MinimizerOptions(100, 1e-14), x, at);
    EXPECT_TRUE(stats.converged);
    EXPECT_NEAR(1, x[0], 1e-6);
    EXPECT_NEAR(1, x[1], 1e-6);
    EXPECT_NEAR(0, at.cost, 1e-12);
    EXPECT_LT(stats.steps, 40);
}

// Where steps have to be far shorter than they look at first, what a short one gains says nothing about the minimum.
TEST(RSAckermann_Optim, minimum_that_is_far_away)
{
    const MockProblem problem([](const Unknowns& x) { return Eigen::VectorXd::Constant(1, std::atan(x[0])); });
    Unknowns x = vectorOf({1e3});
    SmallEquations at;
    EXPECT_TRUE(minimize(problem, MinimizerOptions(100, 0.003), x, at).converged);
    EXPECT_NEAR(0, x[0], 0.1);
}

TEST(RSAckermann_Optim, steps_are_limited)
{
    const MockProblem problem(rosenbrock);
    Unknowns x = vectorOf({-1.2, 1});
    SmallEquations at;
    const MinimizerStats stats = minimize(problem, MinimizerOptions(3, 1e-14), x, at);
    EXPECT_FALSE(stats.converged);
    EXPECT_EQ(3, stats.steps);
    EXPECT_LE(problem.evaluations, 4);
    EXPECT_EQ(rosenbrock(x).squaredNorm(), at.cost);
}

TEST(RSAckermann_Optim, no_steps_towards_what_is_too_far)
{
    // 100 above that of the valley alone
    const MockProblem problem([](const Unknowns& v) {
        const Eigen::VectorXd r = rosenbrock(v);
        return Eigen::VectorXd(Eigen::Vector3d(r[0], r[1], 10));
    });
    for (double farthest : {50., 101.})
    {
        Unknowns x = vectorOf({-1.2, 1});
        SmallEquations at;
        MinimizerOptions options(40, 1e-12);
        options.farthest = farthest;
        const MinimizerStats stats = minimize(problem, options, x, at);
        EXPECT_EQ(farthest > 100, stats.converged);
        EXPECT_LE(at.cost, 100 + rosenbrock(vectorOf({-1.2, 1})).squaredNorm());
        if (farthest < 100)
            EXPECT_LT(stats.steps, 15);
        else
            EXPECT_NEAR(100, at.cost, 1e-9);
    }
}

TEST(RSAckermann_Optim, linear_problem_takes_few_steps)
{
    Eigen::MatrixXd A = Eigen::MatrixXd::Random(9, 4);
    const Eigen::VectorXd b = Eigen::VectorXd::Random(9);
    const MockProblem problem([&](const Unknowns& x) { return Eigen::VectorXd(A * x - b); });
    Unknowns x = vectorOf({5, -3, 2, 9});
    SmallEquations at;
    const MinimizerStats stats = minimize(problem, MinimizerOptions(20, 1e-12), x, at);
    const Eigen::MatrixXd covariance = Eigen::MatrixXd(A.transpose() * A).inverse();
    const Eigen::VectorXd expected = covariance * (A.transpose() * b);
    EXPECT_LE(stats.steps, 4);
    EXPECT_LT((x - expected).norm(), 1e-5);
    EXPECT_LT((scaledInverse(at.symmetric()) - covariance).norm(), 1e-6 * covariance.norm());
}

// What no residual tells stays as it was.
TEST(RSAckermann_Optim, unknowns_without_evidence_stay)
{
    const MockProblem problem(
        [](const Unknowns& x) { return Eigen::VectorXd(Eigen::Vector2d(x[0] + x[1] - 3, 2 * (x[0] + x[1] - 3))); });
    Unknowns x = vectorOf({0, 1, 7});
    SmallEquations at;
    EXPECT_TRUE(minimize(problem, MinimizerOptions(20, 1e-12), x, at).converged);
    EXPECT_NEAR(3, x[0] + x[1], 1e-5);
    EXPECT_EQ(7, x[2]);
    EXPECT_GT(scaledInverse(at.symmetric())(2, 2), 1e8);
}

TEST(RSAckermann_Optim, limits_are_kept)
{
    MockProblem problem([](const Unknowns& x) { return Eigen::VectorXd(Eigen::Vector2d(x[0] - 2, 0.1 * x[1])); });
    problem.limits = [](const Unknowns& x) { return x[0] <= 1; };
    Unknowns x = vectorOf({0, 1});
    SmallEquations at;
    minimize(problem, MinimizerOptions(60, 1e-12), x, at);
    EXPECT_LE(x[0], 1);
    EXPECT_GT(x[0], 0.9);
}

TEST(RSAckermann_Optim, states_whose_cost_is_not_a_number_are_not_taken)
{
    // Logarithms of what a full step makes negative
    const MockProblem problem(
        [](const Unknowns& x) { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, std::log(x[0]) + 3)); });
    Unknowns x = vectorOf({5});
    SmallEquations at;
    EXPECT_TRUE(minimize(problem, MinimizerOptions(100, 1e-14), x, at).converged);
    EXPECT_NEAR(std::exp(-3.), x[0], 1e-6);
    const MockProblem nowhere([](const Unknowns& v) { return Eigen::VectorXd(NAN * v); });
    Unknowns start = vectorOf({5, 6});
    EXPECT_FALSE(minimize(nowhere, MinimizerOptions(1000, 1e-14), start, at).converged);
    EXPECT_EQ(vectorOf({5, 6}), start);
}

TEST(RSAckermann_Optim, no_unknowns)
{
    const MockProblem problem([](const Unknowns&) { return Eigen::VectorXd(Eigen::Vector2d(3, 4)); });
    Unknowns x;
    x.resize(0);
    SmallEquations at;
    EXPECT_TRUE(minimize(problem, MinimizerOptions(5, 1e-9), x, at).converged);
    EXPECT_EQ(25, at.cost);
}

// The inverse keeps its digits although the units differ.
TEST(RSAckermann_Optim, scaled_inverse)
{
    const Eigen::Vector3d units(1e-5, 1, 1e5);
    Eigen::Matrix3d correlation;
    correlation << 1, 0.5, 0.2, 0.5, 1, -0.4, 0.2, -0.4, 1;
    const Eigen::Matrix3d covariance = units.asDiagonal() * correlation * units.asDiagonal(),
                          inverse = units.cwiseInverse().asDiagonal() * correlation.inverse() *
                                    units.cwiseInverse().asDiagonal(),
                          got = scaledInverse(inverse);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            EXPECT_NEAR(covariance(i, j) / (units[i] * units[j]), got(i, j) / (units[i] * units[j]), 1e-6);
}

TEST(RSAckermann_Optim, schur_complement_is_a_part_of_the_inverse)
{
    enum { ELIMINATED = 5, OTHERS = 3, ALL = ELIMINATED + OTHERS };
    typedef Eigen::Matrix<double, ELIMINATED, OTHERS> ByOthers;
    typedef Eigen::Matrix<double, ELIMINATED, 1> Eliminated;
    std::srand(3);
    for (int i = 0; i < 10000; i++)
    {
        const Eigen::Matrix<double, ALL, ALL + 2> J = Eigen::Matrix<double, ALL, ALL + 2>::Random();
        const Eigen::Matrix<double, ALL, ALL> H = J * J.transpose() + 0.1 * Eigen::Matrix<double, ALL, ALL>::Identity();
        const Eigen::MatrixXd inverse = Eigen::MatrixXd(H).inverse();
        const Eigen::Matrix<double, ALL, 1> g = Eigen::Matrix<double, ALL, 1>::Random(), step = -inverse * g;
        const Eigen::Matrix<double, ELIMINATED, ELIMINATED> A = H.topLeftCorner<ELIMINATED, ELIMINATED>();
        const ByOthers B = H.topRightCorner<ELIMINATED, OTHERS>();
        Eigen::Matrix3d C = H.bottomRightCorner<OTHERS, OTHERS>();
        Eigen::Vector3d b = g.tail<OTHERS>();
        const Eliminated a = g.head<ELIMINATED>();
        const SchurComplement<ByOthers, Eliminated> eliminated(A.llt().solve(B), A.llt().solve(a), a);
        eliminated.reduce(B, C, b);
        const Eigen::Vector3d others = -C.inverse() * b;
        const double tolerance = 1e-9 * inverse.norm();
        ASSERT_LT((C.inverse() - inverse.bottomRightCorner<OTHERS, OTHERS>()).norm(), tolerance) << i;
        ASSERT_LT((others - step.tail<OTHERS>()).norm(), tolerance) << i;
        ASSERT_LT((eliminated.substitute(others) - step.head<ELIMINATED>()).norm(), tolerance) << i;
        ASSERT_NEAR(-step.dot(g), eliminated.gain - others.dot(b), tolerance) << i;
    }
}

template <class Loss>
void checkLoss(const Loss& loss)
{
    for (double r2 = 0.01; r2 < 1e4; r2 *= 1.7)
    {
        const double h = 1e-4 * r2;
        EXPECT_NEAR((loss.cost(r2 + h) - loss.cost(r2 - h)) / (2 * h), loss.slope(r2), 1e-6) << r2;
        EXPECT_LT(loss.cost(r2), loss.weight * r2);
        EXPECT_LT(loss.slope(1.1 * r2), loss.slope(r2));
    }
    EXPECT_EQ(0, loss.cost(0));
    EXPECT_EQ(loss.weight, loss.slope(0));
}

TEST(RSAckermann_Optim, slopes_of_robust_losses_are_derivatives)
{
    checkLoss(GemanMcClureLoss<double>(3, 0.2));
    checkLoss(CauchyLoss(2, 0.7));
    EXPECT_NEAR(0.2 * 9, GemanMcClureLoss<double>(3, 0.2).cost(1e9), 1e-6);
    EXPECT_NEAR(0.7 * 4 * std::log(1 + 100 / 4.), CauchyLoss(2, 0.7).cost(100), 1e-9);
}

}} // namespace opencv_test::
