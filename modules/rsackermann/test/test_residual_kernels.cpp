// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"

// Internals of the library that it doesn't export: the kernels with the vectors that the tests are compiled for, in a
// namespace of their own.
#undef CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN
#undef CV_CPU_OPTIMIZATION_NAMESPACE_END
#define CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN namespace tested {
#define CV_CPU_OPTIMIZATION_NAMESPACE_END }
#include "../src/factors/residual_kernels.simd.hpp"

// And what they are if there are no vectors.
#undef CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN
#define CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN namespace tested_without_vectors {
#undef CV_SIMD_64F
#define CV_SIMD_64F 0
#include "../src/factors/residual_kernels.simd.hpp"

#include "../src/factors/segment_residuals.hpp"
#include "../src/factors/segment_arrays.hpp"
#include "test_direction_residual.hpp"

namespace opencv_test { namespace {

namespace vectors = cv::rsackermann::tested;
namespace scalars = cv::rsackermann::tested_without_vectors;

const double FOCAL = 800, SIGMA = 0.5, LEAN = 0.002;
// How exact sums over residuals are. In single precision bearings are rounded to 1e-7, some 1e-4 sigmas of a residual;
// random segments are hundreds of sigmas away, and where two planes are equally near it may be on the other one.
struct Precision
{
    double relative;
    double inView;  // farthest end that is compared, over the focal length
    int exceptions; // of 3000 sets
};
const Precision DOUBLE_PRECISION = {1e-10, DBL_MAX, 0}, SINGLE_PRECISION = {5e-3, 5, 3};

Model randomModel(RNG& rng)
{
    Model m;
    m.direction = rng.uniform(0, 2) ? 1 : -1;
    m[P_ALPHA] = rng.uniform(-0.1, 0.1);
    m[P_B] = rng.uniform(-0.3, 0.3);
    m[P_D] = rng.uniform(-0.1, 0.1);
    m[P_LAMBDA] = rng.uniform(0, 3) ? rng.uniform(0.4, 2.5) : 0;
    m[P_ROLL] = rng.uniform(-0.05, 0.05);
    m[P_PITCH] = rng.uniform(-0.05, 0.05);
    m[P_STREET] = rng.uniform(-1., 1.);
    return m;
}

std::vector<UprightSegment> randomSegments(RNG& rng, int count, double slant, double largestTime)
{
    std::vector<UprightSegment> segments(count);
    for (int i = 0; i < count; i++)
    {
        UprightSegment& c = segments[i];
        const Point2d u = uniformPoint(rng, Point2d(-0.6, -0.4), Point2d(0.6, 0.4)),
                      v = uniformPoint(rng, Point2d(-slant, -0.4), Point2d(slant, 0.4));
        c.u = Vec3d(u.x, u.y, 1);
        c.v = Vec3d(u.x + v.x, v.y, 1);
        c.timeU = rng.uniform(-largestTime, largestTime);
        c.timeV = rng.uniform(-largestTime, largestTime);
        c.sagitta = rng.uniform(0., 2.);
    }
    return segments;
}

FreeParameters randomParameters(RNG& rng)
{
    FreeParameters unknowns;
    for (int p = 0; p < PARAMETERS; p++)
        if (rng.uniform(0, 3))
            unknowns.add(Parameter(p));
    return unknowns;
}

typedef double (*Residual)(const UprightSegment&, const PreparedModel&, double*);

double vertical(const UprightSegment& c, const PreparedModel& m, double* jacobian)
{
    int wall;
    return verticalResidual(c, m, wall, jacobian);
}

// The sums over the residuals one by one.
ResidualSums expectedSums(const std::vector<UprightSegment>& segments, const PreparedModel& m, const RobustLoss& loss,
                          const FreeParameters& unknowns, Residual residual)
{
    ResidualSums sums;
    for (size_t i = 0; i < segments.size(); i++)
    {
        const double leaning = FOCAL * LEAN * cv::norm(segments[i].u - segments[i].v);
        const double scale = FOCAL / std::hypot(std::hypot(SIGMA, std::sqrt(4. / 45) * segments[i].sagitta), leaning);
        double jacobian[PARAMETERS];
        const double r = scale * residual(segments[i], m, jacobian), s2 = loss.scale2, q = s2 + r * r;
        const double weight = loss.weight * s2 * s2 / (q * q);
        sums.cost += loss.weight * r * r * s2 / q;
        for (int k = 0; k < unknowns.count; k++)
        {
            sums.gradient[k] += weight * scale * jacobian[unknowns.index[k]] * r;
            for (int l = 0; l <= k; l++)
                sums.hessian[k][l] +=
                    weight * scale * scale * jacobian[unknowns.index[k]] * jacobian[unknowns.index[l]];
        }
    }
    return sums;
}

//! The largest coordinate of an end in the global-shutter image, with a focal length of 1.
double farthestEnd(const SegmentArrays& segments, const PreparedModel& model)
{
    const int padded = segments.paddedSize();
    std::vector<float> points(size_t(4) * padded);
    scalars::compensateSegments(segments, model, points.data());
    double farthest = 0;
    for (int field = 0; field < 4; field++)
        for (int i = 0; i < segments.size(); i++)
            farthest = std::max(farthest, double(std::abs(points[size_t(field) * padded + i])));
    return farthest;
}

/** Rounding errors of a derivative grow with the distance of the ends from the centre of the global-shutter image: what
a moving end and the middle that moves with it contribute nearly cancels if the end is close to infinity. A compiler
that fuses multiplications with additions rounds each description of a formula in a way of its own: with FMA 360000 sets
of segments took up to a tenth of what is allowed. Without it there is only the order of the addition, 1e-15.
@param eps for numbers of the size of 1.
*/
bool areAlike(const ResidualSums& expected, const ResidualSums& sums, const FreeParameters& unknowns, double eps)
{
    const auto isNear = [eps](double a, double b, double size) { return std::abs(a - b) <= eps * (1 + size); };
    bool alike = isNear(expected.cost, sums.cost, expected.cost);
    for (int k = 0; k < unknowns.count; k++)
    {
        const double square = expected.hessian[k][k];
        alike = alike && isNear(expected.gradient[k], sums.gradient[k], std::sqrt(square * expected.cost));
        for (int l = 0; l <= k; l++)
            alike =
                alike && isNear(expected.hessian[k][l], sums.hessian[k][l], std::sqrt(square * expected.hessian[l][l]));
    }
    return alike;
}

typedef void (*AddSegments)(const SegmentArrays&, const PreparedModel&, const RobustLoss&, const FreeParameters&,
                            ResidualSums&);

// Any number of segments, any unknowns, and row times within and beyond what the series serve.
void testSums(AddSegments add, Residual residual, double slant, const Precision& precision)
{
    RNG& rng = theRNG();
    int compared = 0, different = 0;
    for (int i = 0; i < 3000; i++)
    {
        const Model model = randomModel(rng);
        const bool translates = rng.uniform(0, 2) == 1;
        const double roadRatio = rng.uniform(1., 3.), heading = rng.uniform(-CV_PI, CV_PI),
                     largestTime = rng.uniform(0, 5) ? 0.5 : 5.;
        const PreparedModel prepared(model, heading, roadRatio, translates);
        const std::vector<UprightSegment> segments = randomSegments(rng, rng.uniform(0, 20), slant, largestTime);
        const FreeParameters unknowns = randomParameters(rng);
        const double weight = rng.uniform(0.1, 1.), lossScale = rng.uniform(1., 100.);
        const RobustLoss loss(lossScale, weight);
        SegmentArrays arrays;
        arrays.assign(segments);
        arrays.weigh(segments, FOCAL, SIGMA, LEAN);
        ResidualSums sums;
        add(arrays, prepared, loss, unknowns, sums);
        const double farthest = farthestEnd(arrays, prepared);
        if (farthest > precision.inView)
            continue;
        compared++;
        different += !areAlike(expectedSums(segments, prepared, loss, unknowns, residual), sums, unknowns,
                               precision.relative * (1 + farthest));
    }
    EXPECT_GT(compared, 2000);
    EXPECT_LE(different, precision.exceptions);
}

TEST(RSAckermann_ResidualKernels, sums_of_verticals)
{
    testSums(vectors::addVerticals, vertical, 0.05, DOUBLE_PRECISION);
    testSums(scalars::addVerticals, vertical, 0.05, DOUBLE_PRECISION);
}

TEST(RSAckermann_ResidualKernels, sums_of_verticals_in_single_precision)
{
    testSums(vectors::addVerticalsInSinglePrecision, vertical, 0.05, SINGLE_PRECISION);
    testSums(scalars::addVerticalsInSinglePrecision, vertical, 0.05, SINGLE_PRECISION);
}

TEST(RSAckermann_ResidualKernels, sums_of_directions)
{
    testSums(vectors::addDirections, directionResidual, 0.5, SINGLE_PRECISION);
    testSums(scalars::addDirections, directionResidual, 0.5, SINGLE_PRECISION);
}

typedef double (*Score)(const SegmentArrays&, const PreparedModel&, double, double, double, int&);

void testScore(Score scoreVerticals)
{
    RNG& rng = theRNG();
    int stopped = 0;
    for (int i = 0; i < 3000; i++)
    {
        const double heading = rng.uniform(-CV_PI, CV_PI);
        const PreparedModel prepared(randomModel(rng), heading);
        const std::vector<UprightSegment> segments = randomSegments(rng, rng.uniform(0, 100), 0.01, 0.5);
        SegmentArrays arrays;
        arrays.assign(segments);
        const double threshold = rng.uniform(1., 20.), best = rng.uniform(0, 2) ? DBL_MAX : rng.uniform(0., 1e4);
        double expected = 0, error = 0;
        int expectedInliers = 0, undecided = 0;
        for (size_t k = 0; k < segments.size(); k++)
        {
            const double r = FOCAL * vertical(segments[k], prepared, 0), precision = 1e-3;
            expected += std::min(r * r, threshold * threshold);
            error += std::abs(r) < threshold + precision ? 2 * precision * threshold : 0;
            expectedInliers += std::abs(r) < threshold;
            undecided += std::abs(std::abs(r) - threshold) < precision;
        }
        int inliers = -1;
        const double score = scoreVerticals(arrays, prepared, FOCAL, threshold, best, inliers);
        if (expected - error > best)
        {
            ASSERT_GE(score, best);
            stopped += score < expected - error;
            continue;
        }
        ASSERT_NEAR(expected, score, error + 1e-6 * expected);
        ASSERT_NEAR(expectedInliers, inliers, undecided);
    }
    EXPECT_GT(stopped, 100);
}

TEST(RSAckermann_ResidualKernels, score)
{
    testScore(vectors::scoreVerticals);
    testScore(scalars::scoreVerticals);
}

// The cost of a street is that of the residuals of segments that another model, with the street there, sees.
TEST(RSAckermann_ResidualKernels, street_cost)
{
    RNG& rng = theRNG();
    for (int i = 0; i < 3000; i++)
    {
        Model model = randomModel(rng);
        const double heading = rng.uniform(-CV_PI, CV_PI), ratio = rng.uniform(1., 3.), scale = rng.uniform(10., 500.);
        const std::vector<UprightSegment> segments = randomSegments(rng, rng.uniform(0, 20), 0.5, 0.5);
        SegmentArrays arrays;
        arrays.assign(segments);
        std::vector<float> points(4 * arrays.paddedSize() + 1);
        const Model unturned = model;
        vectors::compensateSegments(arrays, PreparedModel(unturned, heading, ratio), points.data());
        const double street = rng.uniform(-1., 1.);
        model[P_STREET] = street;
        const PreparedModel prepared(model, heading, ratio, false);
        double expected = 0;
        for (size_t k = 0; k < segments.size(); k++)
        {
            const double r = scale * directionResidual(segments[k], prepared, 0);
            expected += r * r / (1 + r * r);
        }
        const double x = std::sin(street), z = std::cos(street), eps = 1e-4 * (1 + expected);
        ASSERT_NEAR(expected, vectors::streetCost(points.data(), arrays.paddedSize(), x, z, scale), eps);
        scalars::compensateSegments(arrays, PreparedModel(unturned, heading, ratio), points.data());
        ASSERT_NEAR(expected, scalars::streetCost(points.data(), arrays.paddedSize(), x, z, scale), eps);
    }
}

}} // namespace
