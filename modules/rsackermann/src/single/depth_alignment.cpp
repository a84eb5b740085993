// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/axis_rotations.hpp"
#include "../camera/lens.hpp"
#include "../factors/driving_prior.hpp"
#include "../factors/robust_losses.hpp"
#include "../factors/segment_residuals.hpp"
#include "../optim/levenberg_marquardt.hpp"
#include "../optim/normal_equations.hpp"
#include "depth_alignment.hpp"
#include "displacement_field.hpp"
#include "relative_depth.hpp"
#include "slant_noise.hpp"

namespace cv { namespace rsackermann {

// doc/theory.md, "Relative depth", has the reasons.
static const double LEAST_IN_COMMON = 2.5; // sigmas

namespace {

// A vertical at the depth that the map has beside it.
struct DeepVertical
{
    UprightSegment segment;
    double height; // of the camera over the depth along the optical axis
    double sigma;  // of the difference of its columns
};

// The unknowns: the motion, and the road's G, which scales the depth.
enum { A_ALPHA, A_LOG_ROAD, A_ROLL, A_PITCH, UNKNOWNS };
typedef NormalEquations<UNKNOWNS>::Vector Aligned;

// The verticals and what is known without them, as minimize() takes it.
class AlignmentProblem
{
public:
    typedef Aligned State;
    typedef NormalEquations<UNKNOWNS> Equations;
    typedef Aligned Step;

    AlignmentProblem(const RollingShutterCamera& camera, const AckermannEstimator::Params& params,
                     const DrivingPrior& prior_, int direction_)
        : prior(prior_), heading(camera.heading), direction(direction_), focal(camera.cameraMatrix(0, 0)),
          maxAlpha(MotionLimits(camera, params).maxAlpha),
          rollSigma(params.gravitySigma > 0 ? params.gravitySigma : EXACT_GRAVITY),
          pitchSigma(params.gravitySigma > 0 ? params.vehiclePitchSigma : EXACT_GRAVITY),
          loss(SLANT_SCALE, 1 / dependenceOf(std::hypot(heading.c * rollSigma, heading.s * pitchSigma)))
    {
        prior.anyRoad(logRoad, logRoadSigma);
    }

    void add(const UprightSegment& segment, double height)
    {
        const double lean = PRIOR_LEAN * norm(segment.u - segment.v), placed = 0.25 / focal; // by the detector
        verticals.push_back({segment, height, std::hypot(lean, placed)});
    }

    bool empty() const { return verticals.empty(); }

    // What to expect before the verticals are seen.
    Aligned start(const AckermannMotion& motion) const
    {
        return Aligned(motion.alpha, logRoad, motion.rollCorrection, motion.pitchCorrection);
    }

    void evaluate(const Aligned& state, Equations& equations) const
    {
        const double by = 1e-6;
        equations = Equations();
        for (const DeepVertical& v : verticals)
        {
            Eigen::Matrix<double, UNKNOWNS, 1> J;
            for (int i = 0; i < UNKNOWNS; i++)
            {
                Aligned more = state, less = state;
                more[i] += by;
                less[i] -= by;
                J[i] = (residual(v, more) - residual(v, less)) / (2 * by);
            }
            equations.add(J, Eigen::Matrix<double, 1, 1>(residual(v, state)), loss);
        }
        addPriors(state, equations);
    }

    static Aligned moved(const Aligned& state, const Aligned& step) { return state + step; }

    bool allows(const Aligned& state) const { return std::abs(state[A_ALPHA]) < maxAlpha; }

private:
    // The difference of the compensated columns of both ends, in sigmas. All of a vertical has the horizontal depth of
    // its middle.
    double residual(const DeepVertical& v, const Aligned& state) const
    {
        const Matx33d tilt = tiltRotation(state[A_ROLL], state[A_PITCH]);
        const UprightSegment& s = v.segment;
        const Vec3d middle = tilt * (0.5 * (s.u + s.v));
        const RowMotion row(state[A_ALPHA], heading, 0.5 * (s.timeU + s.timeV));
        double N, M;
        row.turn(middle[0], middle[2], N, M);
        const double seen = direction * std::exp(state[A_LOG_ROAD]) * v.height,
                     w = seen / (M + seen * row.tau * row.c2);
        return (columnOf(tilt * s.u, s.timeU, w, state) - columnOf(tilt * s.v, s.timeV, w, state)) / v.sigma;
    }

    // doc/theory.md, "Compensation".
    double columnOf(const Vec3d& bearing, double t, double w, const Aligned& state) const
    {
        const RowMotion row(state[A_ALPHA], heading, t);
        double N, M;
        row.turn(bearing[0], bearing[2], N, M);
        return (1 - row.tau * w * row.c2) * N / M + row.tau * w * row.s2;
    }

    void addPriors(const Aligned& state, Equations& equations) const
    {
        Model turning;
        turning[P_ALPHA] = state[A_ALPHA];
        Jet yaw[DrivingPrior::MAX_RESIDUALS];
        prior.evaluate(turning, MotionHypothesis(MODEL_1LA, 0), yaw);
        const double c = heading.c, s = heading.s;
        Eigen::Matrix<double, UNKNOWNS, UNKNOWNS> J;
        J.setZero();
        Eigen::Matrix<double, UNKNOWNS, 1> r(yaw[0].value, (state[A_LOG_ROAD] - logRoad) / logRoadSigma,
                                             (c * state[A_ROLL] - s * state[A_PITCH]) / rollSigma,
                                             (s * state[A_ROLL] + c * state[A_PITCH]) / pitchSigma);
        J(A_ALPHA, 0) = yaw[0].derivative[P_ALPHA];
        J(A_LOG_ROAD, 1) = 1 / logRoadSigma;
        J(A_ROLL, 2) = c / rollSigma;
        J(A_PITCH, 2) = -s / rollSigma;
        J(A_ROLL, 3) = s / pitchSigma;
        J(A_PITCH, 3) = c / pitchSigma;
        equations.cost += r.squaredNorm();
        equations.gradient += J * r;
        equations.information += J * J.transpose();
    }

    const DrivingPrior& prior;
    Heading heading;
    int direction;
    double focal, maxAlpha, rollSigma, pitchSigma, logRoad, logRoadSigma;
    RobustLoss loss;
    std::vector<DeepVertical> verticals;
};

// To first order (doc/theory.md, "Posterior"), as means over the image.
struct ExpectedDisplacement
{
    double raw, residual;

    ExpectedDisplacement(const RollingShutterCamera& camera, const RelativeDepth& depth, int direction,
                         const Aligned& state, const AlignmentProblem::Equations::Matrix& covariance)
        : raw(0), residual(0)
    {
        const DisplacementField field(camera);
        const Heading heading(camera.heading);
        int count = 0;
        for (int k = 0; k < DisplacementField::POINTS; k++)
        {
            const DisplacementField::Point& p = field.point(k);
            const double height = std::max(depth.at(p.pixel), 0.);
            if (!(p.z > IN_FRONT) || !std::isfinite(height))
                continue;
            const double w = direction * std::exp(state[A_LOG_ROAD]) * height / p.z;
            const Vec2d byAlpha = p.byAlpha(), byLogRoad = p.byInverseDepth(heading.s, heading.c) * w;
            const double variance = byAlpha.dot(byAlpha) * covariance(A_ALPHA, A_ALPHA) +
                                    2 * byAlpha.dot(byLogRoad) * covariance(A_ALPHA, A_LOG_ROAD) +
                                    byLogRoad.dot(byLogRoad) * covariance(A_LOG_ROAD, A_LOG_ROAD),
                         ofMean = 2 / CV_PI; // the mean of a normal deviate's magnitude, squared, over its variance
            raw += norm(state[A_ALPHA] * byAlpha + byLogRoad);
            residual += std::sqrt(std::max(ofMean * variance, 0.));
            count++;
        }
        raw /= std::max(count, 1);
        residual /= std::max(count, 1);
    }
};

// The walls stay as they are where the depth is unknown; their correlations with the yaw rate stay, too.
void report(const Aligned& state, double alphaSigma, const ExpectedDisplacement& expected, AckermannMotion& motion)
{
    const double before = std::sqrt(motion.covariance(0, 0));
    for (int i = 1; i < 4; i++)
        motion.covariance(0, i) = motion.covariance(i, 0) *= before > 0 ? alphaSigma / before : 0;
    motion.covariance(0, 0) = alphaSigma * alphaSigma;
    motion.model = MODEL_4LA;
    motion.alpha = state[A_ALPHA];
    motion.roadSlope = (motion.direction < 0 ? -1 : 1) * std::exp(state[A_LOG_ROAD]);
    motion.rollCorrection = state[A_ROLL];
    motion.pitchCorrection = state[A_PITCH];
    motion.expectedRaw = expected.raw;
    motion.expectedResidual = expected.residual;
    // An error that exceeds half of the correction, in the opposite direction, makes it worse.
    const double sigma = expected.residual / std::sqrt(2 / CV_PI);
    motion.probabilityWorse = 0.5 * std::erfc(expected.raw / (2 * std::sqrt(2.) * std::max(sigma, DBL_MIN)));
}

} // namespace

bool alignDepth(const RollingShutterCamera& camera, const AckermannEstimator::Params& params, const MotionPrior& given,
                const Mat& segments, AckermannMotion& motion, DepthMap& depth)
{
    const RelativeDepth relative(depth, camera, motion.uprightRotation(camera));
    if (!relative.hasRoad() || relative.edgesInCommon(segments, params.minLength) < LEAST_IN_COMMON)
        return false;
    const int direction = motion.direction < 0 ? -1 : 1;
    const DrivingPrior prior(given, camera, params, MotionLimits(camera, params));
    AlignmentProblem problem(camera, params, prior, direction);
    std::vector<UprightSegment> verticals, others;
    selectCandidates(segments, camera, params, verticals, others);
    for (const UprightSegment& s : verticals)
    {
        double height;
        if (relative.besideSegment(Vec4d(segments.ptr<double>(s.index)), height))
            problem.add(s, height);
    }
    if (problem.empty())
        return false;
    Aligned state = problem.start(motion);
    AlignmentProblem::Equations equations;
    minimize(problem, MinimizerOptions(30, 1e-9, 1e-6), state, equations);
    const AlignmentProblem::Equations::Matrix covariance =
        scaledInverse<AlignmentProblem::Equations::Matrix>(equations.symmetric());
    const ExpectedDisplacement expected(camera, relative, direction, state, covariance);
    const double scale = std::exp(state[A_LOG_ROAD]) / relative.slope(), shift = -scale * relative.infinity();
    const bool areFloats = scale >= FLT_MIN && scale <= FLT_MAX && std::abs(shift) <= FLT_MAX;
    if (!areFloats || !(expected.residual < expected.raw))
        return false;
    report(state, std::sqrt(covariance(A_ALPHA, A_ALPHA)), expected, motion);
    depth.scale = scale;
    depth.shift = shift;
    return true;
}

}} // namespace cv::rsackermann
