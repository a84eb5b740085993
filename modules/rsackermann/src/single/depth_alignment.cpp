// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/axis_rotations.hpp"
#include "../camera/lens.hpp"
#include "../factors/driving_prior.hpp"
#include "../factors/robust_losses.hpp"
#include "../factors/segment_residuals.hpp"
#include "../factors/slant_noise.hpp"
#include "../motion/metric_way.hpp"
#include "../motion/row_tilt.hpp"
#include "../optim/levenberg_marquardt.hpp"
#include "../optim/normal_equations.hpp"
#include "../scene/inverse_depth_offset.hpp"
#include "../scene/planes.hpp"
#include "depth_alignment.hpp"
#include "displacement_field.hpp"
#include "relative_depth.hpp"
#include "yaw_sweep.hpp"
#include <Eigen/LU>

namespace cv { namespace rsackermann {

// doc/theory.md, "Relative depth", has the reasons.
static const double FILLED = 0.025; // of the longer side: what has a depth next to it

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
        : maxAlpha(MotionLimits(camera, params).maxAlpha), prior(prior_), heading(camera.heading),
          direction(direction_), focal(camera.cameraMatrix(0, 0)), tilts(camera, params),
          loss(SLANT_SCALE, 1 / dependenceOf(std::hypot(heading.c * tilts.roll, heading.s * tilts.pitch)))
    {
        prior.anyRoad(logRoad, logRoadSigma);
    }

    void add(const UprightSegment& segment, double height)
    {
        const double lean = PRIOR_LEAN * norm(segment.u - segment.v), placed = 0.25 / focal; // by the detector
        verticals.push_back({segment, height, std::hypot(lean, placed)});
    }

    //! The same at a scaled inverse depth of the compensated bearing.
    void addPlane(const UprightSegment& segment, const Scene& planes, const Aligned& state)
    {
        const RowMotion row(state[A_ALPHA], heading, 0.5 * (segment.timeU + segment.timeV));
        const Vec3d middle = tiltRotation(state[A_ROLL], state[A_PITCH]) * (0.5 * (segment.u + segment.v));
        double N, M;
        row.turn(middle[0], middle[2], N, M);
        const double w = planes.inverseDepth(Vec3d(N / M, middle[1] / M, 1)), seen = w * M / (1 - w * row.tau * row.c2);
        add(segment, direction * std::exp(-state[A_LOG_ROAD]) * seen);
    }

    static MinimizerOptions options() { return MinimizerOptions(30, 1e-9, 1e-6); }

    bool empty() const { return verticals.empty(); }

    //! From now on the yaw rate keeps its value.
    void fixYaw() { firstFree = A_LOG_ROAD; }

    //! From now on the camera doesn't move: nothing but the tilts is unknown.
    void rest(Aligned& state)
    {
        firstFree = A_ROLL;
        state[A_ALPHA] = 0;
        state[A_LOG_ROAD] = -std::numeric_limits<double>::infinity();
    }

    //! The logarithm of the volume that the prior leaves to the road.
    double logRoadVolume() const { return std::log(logRoadSigma * std::sqrt(2 * CV_PI)); }

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
            J.setZero();
            for (int i = firstFree; i < UNKNOWNS; i++)
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

    const double maxAlpha;

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
        const int ofYaw = DrivingPrior::MAX_YAW_RESIDUALS, all = ofYaw + 3;
        Jet yaw[ofYaw];
        const int count = prior.evaluateYaw(state[A_ALPHA], firstFree == A_ALPHA, yaw);
        const double c = heading.c, s = heading.s;
        Eigen::Matrix<double, UNKNOWNS, all> J;
        Eigen::Matrix<double, all, 1> r;
        J.setZero();
        r.setZero();
        for (int i = 0; i < count; i++)
        {
            r[i] = yaw[i].value;
            J(A_ALPHA, i) = firstFree > A_ALPHA ? 0 : yaw[i].derivative[P_ALPHA];
        }
        r.tail<3>() << (firstFree > A_LOG_ROAD ? 0 : (state[A_LOG_ROAD] - logRoad) / logRoadSigma),
            (c * state[A_ROLL] - s * state[A_PITCH]) / tilts.roll,
            (s * state[A_ROLL] + c * state[A_PITCH]) / tilts.pitch;
        J(A_LOG_ROAD, ofYaw) = firstFree > A_LOG_ROAD ? 0 : 1 / logRoadSigma;
        J(A_ROLL, ofYaw + 1) = c / tilts.roll;
        J(A_PITCH, ofYaw + 1) = -s / tilts.roll;
        J(A_ROLL, ofYaw + 2) = s / tilts.pitch;
        J(A_PITCH, ofYaw + 2) = c / tilts.pitch;
        equations.cost += r.squaredNorm();
        equations.gradient += J * r;
        equations.information += J * J.transpose();
    }

    const DrivingPrior& prior;
    Heading heading;
    int direction;
    double focal;
    TiltSigmas tilts;
    double logRoad, logRoadSigma;
    RobustLoss loss;
    int firstFree = A_ALPHA;
    std::vector<DeepVertical> verticals;
};

template <class Matrix>
double logVolume(const Matrix& information)
{
    return 0.5 * double(information.rows()) * std::log(2 * CV_PI) - 0.5 * std::log(information.determinant());
}

// The posterior of a camera that moves: at each of several yaw rates the best road and tilts.
class MovingPosterior
{
public:
    MovingPosterior(AlignmentProblem problem, const DrivingPrior& prior, const Aligned& best, double sigma)
    {
        problem.fixYaw();
        std::vector<double> logMasses, roadVariances;
        std::vector<Aligned> states;
        sweepYaw(best, sigma, prior.alphaScale(), 2 * problem.maxAlpha,
                 [&](Aligned& state, double, double offset, double width) {
                     state[A_ALPHA] = best[A_ALPHA] + offset;
                     if (offset != 0 && !problem.allows(state))
                         return -DBL_MAX;
                     AlignmentProblem::Equations equations;
                     minimize(problem, AlignmentProblem::options(), state, equations);
                     const Eigen::Matrix3d others = equations.symmetric().bottomRightCorner<3, 3>();
                     const double density = prior.logYawDensity(state[A_ALPHA]) + logVolume(others) -
                                            problem.logRoadVolume() - equations.cost / 2;
                     states.push_back(state);
                     logMasses.push_back(density + std::log(width));
                     roadVariances.push_back(scaledInverse(others)(0, 0));
                     return density;
                 });
        const double largest = *std::max_element(logMasses.begin(), logMasses.end());
        double sum = 0;
        for (const double logMass : logMasses)
            sum += std::exp(logMass - largest);
        logEvidence = largest + std::log(sum);
        for (size_t i = 0; i < states.size(); i++)
            mean += std::exp(logMasses[i] - logEvidence) * states[i];
        for (size_t i = 0; i < states.size(); i++)
        {
            const Eigen::Vector2d away = (states[i] - mean).head<2>();
            Eigen::Matrix2d square = away * away.transpose();
            square(A_LOG_ROAD, A_LOG_ROAD) += roadVariances[i];
            covariance += std::exp(logMasses[i] - logEvidence) * square;
        }
    }

    Aligned mean = Aligned::Zero();
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero(); // of alpha and the logarithm of the road
    double logEvidence;
};

// Whether verticals have less of a slant left by the planes than by a depth in metres.
bool contradictsVerticals(const RelativeDepth& relative, const AlignmentProblem& none, const Mat& segments,
                          const std::vector<UprightSegment>& verticals, double way, const AckermannMotion& motion)
{
    const Aligned state = none.start(motion);
    const Scene planes(motion);
    AlignmentProblem byDepth = none, byPlanes = none;
    for (const UprightSegment& s : verticals)
    {
        double height;
        if (!relative.besideSegment(Vec4d(segments.ptr<double>(s.index)), height))
            continue;
        byDepth.add(s, std::abs(way) * relative.slope() * height * std::exp(-state[A_LOG_ROAD]));
        byPlanes.addPlane(s, planes, state);
    }
    AlignmentProblem::Equations ofDepth, ofPlanes;
    byDepth.evaluate(state, ofDepth);
    byPlanes.evaluate(state, ofPlanes);
    return !(ofDepth.cost - ofPlanes.cost < BARE_MENTION);
}

} // namespace

void setAlphaVariance(double variance, AckermannMotion& motion)
{
    const double before = motion.covariance(0, 0), share = before > 0 ? std::sqrt(variance / before) : 0;
    for (int i = 1; i < 4; i++)
        motion.covariance(0, i) = motion.covariance(i, 0) *= share;
    motion.covariance(0, 0) = variance;
}

void expectWithDepth(const RollingShutterCamera& camera, const DepthMap& depth, double scale, double shift,
                     const Matx33d& covariance, const std::vector<Point2d>& seen, const AckermannMotion& byPlanes,
                     AckermannMotion& motion)
{
    const DisplacementField field(camera, seen);
    const Heading heading(camera.heading);
    const Scene planes(motion), planesBefore(byPlanes);
    const InverseDepthOffset offset(byPlanes);
    const int direction = motion.direction < 0 ? -1 : 1;
    const double reach = std::max(camera.imageSize.width, camera.imageSize.height) * FILLED;
    DisplacementField::Values displacement;
    DisplacementField::Variances variances;
    double differ = 0, mayDiffer = 0;
    int compared = 0;
    for (int k = 0; k < DisplacementField::POINTS; k++)
    {
        const DisplacementField::Point& p = field.point(k);
        const double value = RelativeDepth::medianAround(depth, p.pixel, reach), inverse = scale * value + shift,
                     ofPlanes = CV_PI / 2 * std::pow(p.weight * byPlanes.expectedResidual, 2);
        const Vec3d ray(p.x, p.y, 1);
        const Vec2d byAlpha = p.byAlpha(), byInverse = p.byInverseDepth(heading.s, heading.c);
        const auto withPlanes = [&](double alpha, const Scene& scene) -> Vec2d {
            return alpha * byAlpha + (scene.inverseDepth(ray) + offset.at(ray)) * byInverse;
        };
        Vec2d moved = withPlanes(motion.alpha, planes);
        variances[k] = ofPlanes;
        const bool isKnown = p.z > IN_FRONT && std::isfinite(inverse);
        if (isKnown)
        {
            const double byShift = inverse > 0 ? direction / p.z : 0;
            moved = motion.alpha * byAlpha + direction * std::max(inverse, 0.) / p.z * byInverse;
            variances[k] = 0;
            for (int axis = 0; axis < 2; axis++)
            {
                const Vec3d J(byAlpha[axis], byShift * value * byInverse[axis], byShift * byInverse[axis]);
                variances[k] += std::max(J.dot(covariance * J), 0.);
            }
        }
        if (isKnown && byPlanes.status == MOTION_OK)
        {
            differ += norm(moved - withPlanes(byPlanes.alpha, planesBefore));
            mayDiffer += std::sqrt(2 / CV_PI * (variances[k] + ofPlanes));
            compared++;
        }
        displacement[2 * k] = moved[0];
        displacement[2 * k + 1] = moved[1];
    }
    // What planes and depth differ by beyond what both are expected to err by is an error of either.
    const double excess =
        CV_PI / 2 * std::max(differ * differ - mayDiffer * mayDiffer, 0.) / std::max(compared * compared, 1);
    for (int k = 0; k < DisplacementField::POINTS; k++)
        variances[k] += std::pow(field.point(k).weight, 2) * excess / 2;
    field.addTilt(RowTilt(camera, motion), displacement);
    field.addTiltVariance(motion.pitchRateSigma, motion.rollRateSigma, variances);
    motion.expectedRaw =
        DisplacementField::meanDistance(displacement, DisplacementField::Values(), DisplacementField::Variances());
    motion.expectedResidual = DisplacementField::meanDistance(displacement, displacement, variances);
}

// With some probability it is another motion, such as rest: then a correction leaves itself.
static void mixWithRest(double probability, AckermannMotion& motion)
{
    motion.probabilityWorse = probability + (1 - probability) * DisplacementField::probabilityWorse(
                                                                    motion.expectedRaw, motion.expectedResidual);
    motion.expectedResidual = probability * motion.expectedRaw + (1 - probability) * motion.expectedResidual;
    motion.expectedRaw *= 1 - probability;
}

bool alignDepth(const RollingShutterCamera& camera, const AckermannEstimator::Params& params, const MotionPrior& given,
                const Mat& segments, AckermannMotion& motion, DepthMap& depth)
{
    const bool inMetres = depth.kind == DEPTH_METRIC;
    const RelativeDepth relative(depth, camera, motion.uprightRotation(camera));
    if (inMetres
            ? motion.status != MOTION_OK || !isMetric(camera, motion) || relative.isInAnotherUnit(camera.height, params)
            : !relative.hasRoad() || relative.edgesInCommon(segments, params.minLength) < LEAST_IN_COMMON)
        return false;
    const DrivingPrior prior(given, camera, params);
    const int known = motion.status == MOTION_OK ? motion.direction : prior.givenDirection(),
              direction = known < 0 ? -1 : 1;
    AlignmentProblem problem(camera, withLimitsOf(given, params), prior, direction);
    std::vector<UprightSegment> verticals, others;
    selectCandidates(segments, camera, params, verticals, others);
    if (inMetres)
    {
        const double way = wayPerUnitTime(camera, motion), worse = motion.probabilityWorse;
        if (contradictsVerticals(relative, problem, segments, verticals, way, motion))
            return false;
        if (way == 0) // of a camera that turns: the depth says nothing
            return true;
        const double waySigma = wayPerUnitTimeSigma(camera, motion, depth);
        AckermannMotion changed = motion;
        expectWithDepth(camera, depth, std::abs(way), 0,
                        Matx33d::diag(Vec3d(motion.covariance(0, 0), waySigma * waySigma, 0)), std::vector<Point2d>(),
                        motion, changed);
        mixWithRest(worse, changed);
        if (!(changed.expectedResidual < changed.expectedRaw))
            return false;
        motion = changed;
        return true;
    }
    for (const UprightSegment& s : verticals)
    {
        double height;
        if (relative.besideSegment(Vec4d(segments.ptr<double>(s.index)), height))
            problem.add(s, height);
    }
    if (problem.empty())
        return false;
    Aligned state = problem.start(motion), atRest = state;
    AlignmentProblem::Equations equations, rest;
    minimize(problem, AlignmentProblem::options(), state, equations);
    const AlignmentProblem::Equations::Matrix ofState =
        scaledInverse<AlignmentProblem::Equations::Matrix>(equations.symmetric());
    const MovingPosterior moving(problem, prior, state, std::sqrt(ofState(A_ALPHA, A_ALPHA)));
    const Eigen::Matrix2d& covariance = moving.covariance;
    state = moving.mean;
    problem.rest(atRest);
    minimize(problem, AlignmentProblem::options(), atRest, rest);
    // Rest has no yaw rate and no depth that matters.
    const double logOddsOfRest = prior.logRest() - rest.cost / 2 +
                                 logVolume<Eigen::Matrix2d>(rest.symmetric().bottomRightCorner<2, 2>()) -
                                 moving.logEvidence;
    const double scale = std::exp(state[A_LOG_ROAD]) / relative.slope(), shift = -scale * relative.infinity();
    if (!(scale >= FLT_MIN && scale <= FLT_MAX && std::abs(shift) <= FLT_MAX))
        return false;
    AckermannMotion changed = motion; // the walls stay as they are where the depth is unknown
    changed.status = MOTION_OK;
    changed.model = MODEL_4LA;
    changed.direction = direction;
    changed.alpha = state[A_ALPHA];
    changed.roadSlope = direction * std::exp(state[A_LOG_ROAD]);
    changed.rollCorrection = state[A_ROLL];
    changed.pitchCorrection = state[A_PITCH];
    setAlphaVariance(covariance(A_ALPHA, A_ALPHA), changed);
    DepthMap aligned = depth;
    aligned.scale = scale;
    aligned.shift = shift;
    const Matx<double, 3, 2> J(1, 0, 0, scale, 0, shift);
    const Matx22d ofAlphaAndRoad(covariance(A_ALPHA, A_ALPHA), covariance(A_ALPHA, A_LOG_ROAD),
                                 covariance(A_ALPHA, A_LOG_ROAD), covariance(A_LOG_ROAD, A_LOG_ROAD));
    expectWithDepth(camera, depth, scale, shift, J * ofAlphaAndRoad * J.t(), std::vector<Point2d>(), motion, changed);
    mixWithRest(1 / (1 + std::exp(-logOddsOfRest)), changed);
    if (!(changed.expectedResidual < changed.expectedRaw))
        return false;
    motion = changed;
    depth = aligned;
    return true;
}

}} // namespace cv::rsackermann
