// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "frame_fit.hpp"
#include "frame_terms.hpp"
#include "residual_noise.hpp"
#include "../optim/levenberg_marquardt.hpp"
#include "../optim/normal_equations.hpp"

namespace cv { namespace rsackermann {

namespace {

typedef NormalEquations<FLOW_VALUES> FlowEquations;
typedef FlowEquations::Vector Unknowns;
typedef Eigen::Matrix<double, FLOW_VALUES, 2> FlowGradient;
typedef Eigen::Matrix<double, SEQUENCE_VALUES, SEQUENCE_VALUES> StateMatrix;
typedef Eigen::Matrix<double, FLOW_VALUES, CAMERA_VALUES> CameraJacobian;

struct Minimum
{
    Unknowns at;
    FlowEquations equations;
};

class FrameFitProblem
{
public:
    typedef Unknowns State;
    typedef Unknowns Step;
    typedef FlowEquations Equations;

    FrameFitProblem(const RollingShutterCamera& camera_, const std::vector<TrackedBearing>& bearings_,
                    const std::vector<UprightSegment>& verticals_, const SequenceState& prediction, double yawGrowth)
        : bearings(bearings_), residual(camera_), camera(camera_), verticals(verticals_),
          pointWeights(bearings_.size(), Matx22d::eye() * (1 / POINT_SIGMA)), slantWeights(verticals_.size(), 1.),
          unit(camera.secondsPerUnitTime()), focal(camera.cameraMatrix(0, 0)), scale(1)
    {
        FlowEquations::Matrix covariance = FlowEquations::Matrix::Identity() * (TURN_SIGMA * TURN_SIGMA);
        covariance(FLOW_YAW_CHANGE, FLOW_YAW_CHANGE) = yawGrowth * yawGrowth;
        covariance.topLeftCorner<SEQUENCE_VALUES, SEQUENCE_VALUES>() =
            Eigen::Map<const StateMatrix>(prediction.covariance.val);
        prior = scaledInverse(covariance);
        std::copy(prediction.value.val, prediction.value.val + SEQUENCE_VALUES, expected.data());
    }

    double pointCost(const Unknowns& u) const
    {
        FlowEquations equations;
        addPoints(u, equations);
        return equations.cost;
    }

    // Without tolerance from the beginning it finds what is next to the start.
    Minimum refine(const Unknowns& start, bool isTolerant)
    {
        Minimum m;
        m.at = start;
        for (double s : POINT_SCALES)
        {
            scale = s;
            if (isTolerant || s == 1)
                minimize(*this, MinimizerOptions(STEPS, 1e-3), m.at, m.equations);
        }
        return m;
    }

    // Whether most of what is seen above the horizon would have to be of the car itself.
    bool hidesScene(const Unknowns& u) const
    {
        const FlowResidual::Values values(u.data());
        int above = 0, ofOwnCar = 0;
        for (const TrackedBearing& s : bearings)
        {
            if (s.now.y >= 0)
                continue;
            const Point2d r = residual.evaluate(s, values, 0) / POINT_SIGMA;
            above++;
            ofOwnCar += isOfOwnCar(s, r.dot(r));
        }
        return 2 * ofOwnCar > above;
    }

    // With the noise that the points of a minimum show.
    void refineWithNoise(Minimum& m)
    {
        std::vector<Point2d> weak, residuals, byDeviation;
        const FlowResidual::Values values(m.at.data());
        for (const TrackedBearing& s : bearings)
        {
            const FlowResidual::View view = residual.predict(s, values);
            weak.push_back(s.weak);
            residuals.push_back(residual.residualOf(s, values, view));
            byDeviation.push_back(pixelsOfDeviation(residual, s, values, unit, view));
        }
        pointWeights = weightsOf(noiseOf(weak, residuals, byDeviation), weak, byDeviation);
        minimize(*this, MinimizerOptions(STEPS, 1e-3), m.at, m.equations);
    }

    // Lets points count as what they are together, at a minimum with their noise.
    void countTogether(Minimum& m)
    {
        Neighbours neighbours(NEIGHBOURHOOD * std::max(camera.imageSize.width, camera.imageSize.height) / focal);
        const FlowResidual::Values values(m.at.data());
        for (size_t i = 0; i < bearings.size(); i++)
        {
            const FlowResidual::View view = residual.predict(bearings[i], values);
            const Point2d r = residual.residualOf(bearings[i], values, view);
            neighbours.add(bearings[i].now, pointWeights[i] * Vec2d(r.x, r.y),
                           pixelsOfDeviation(residual, bearings[i], values, unit, view));
        }
        dependence = neighbours.dependence();
        m.equations = FlowEquations();
        evaluate(m.at, m.equations);
    }

    void evaluate(const Unknowns& u, FlowEquations& equations) const
    {
        equations.cost = (u - expected).dot(prior * (u - expected));
        equations.gradient = prior * (u - expected);
        equations.information = prior;
        addPoints(u, equations);
        addVerticals(u, equations);
    }

    static Unknowns moved(Unknowns u, const Unknowns& step)
    {
        u += step;
        for (int i = SEQUENCE_LEFT; i <= SEQUENCE_ROAD; i++)
            u[i] = std::max(u[i], 0.);
        return u;
    }

    static bool allows(const Unknowns&) { return true; }

    // The state isn't asked: a scene that isn't made of planes looks to it as if rates changed.
    void measureTurns(const Unknowns& u, NeighbourTurns& before, NeighbourTurns& after) const
    {
        enum { AXES = 3, OF_ONE = 2 * AXES, UNKNOWNS = 2 * OF_ONE }; // angles and then changes, of both neighbours
        NormalEquations<UNKNOWNS> equations;
        const auto firstOf = [](const TrackedBearing& s) { return s.pitch == FLOW_PITCH_BEFORE ? 0 : int(OF_ONE); };
        const auto intervalOf = [&](const TrackedBearing& s) { return (s.timeNow - s.timeOther) * unit; };
        for (const TrackedBearing& s : bearings)
        {
            const double interval = intervalOf(s), angles[AXES] = {0, u[s.pitch], u[s.roll]};
            for (int i = 0; i < AXES; i++)
            {
                const int k = firstOf(s) + i;
                const double weight = 1 / (TURN_SIGMA * TURN_SIGMA);
                equations.information(k, k) = weight;
                equations.gradient[k] = weight * angles[i];
                // Rates that don't depend on each other.
                double& ofChange = equations.information(k + AXES, k + AXES);
                ofChange = std::max(ofChange, weight * interval * interval / 2);
            }
        }
        const FlowResidual::Values values(u.data());
        rsackermann::addPoints<UNKNOWNS>(
            bearings, pointWeights, 1, dependence,
            [&](const TrackedBearing& s, Eigen::Matrix<double, UNKNOWNS, 2>& J) {
                FlowGradient byValues;
                const Point2d r = residual.evaluate(s, values, byValues.data());
                const int first = firstOf(s);
                J.setZero();
                J.row(first) = byValues.row(SEQUENCE_YAW_RATE) / intervalOf(s);
                J.row(first + 1) = byValues.row(s.pitch);
                J.row(first + 2) = byValues.row(s.roll);
                for (int i = first; i < first + AXES; i++)
                    J.row(i + AXES) = s.timeNow * unit * J.row(i);
                return r;
            },
            equations);
        const NormalEquations<UNKNOWNS>::Matrix covariance = scaledInverse(equations.symmetric());
        const NormalEquations<UNKNOWNS>::Vector step = -(covariance * equations.gradient);
        for (int k = 0; k < UNKNOWNS; k += OF_ONE)
        {
            NeighbourTurns& turns = k == 0 ? before : after;
            const double angles[AXES] = {0, u[k == 0 ? FLOW_PITCH_BEFORE : FLOW_PITCH_AFTER],
                                         u[k == 0 ? FLOW_ROLL_BEFORE : FLOW_ROLL_AFTER]};
            RowTurn* const all[AXES] = {&turns.yaw, &turns.pitch, &turns.roll};
            for (int i = 0; i < AXES; i++)
            {
                all[i]->angle = angles[i] + step[k + i];
                all[i]->sigma = std::sqrt(covariance(k + i, k + i));
                all[i]->change = step[k + AXES + i];
            }
        }
    }

    // The state of a minimum, beside changes of the rates of pitch and roll, and intervals that are known vaguely
    // (doc/theory.md, "Rates of rows").
    void setState(const Minimum& m, const FitNuisances& nuisances, SequenceState& state) const
    {
        enum { TURNS = FLOW_YAW_CHANGE - FLOW_PITCH_BEFORE, OTHERS = TURNS + 2, ALL = FLOW_VALUES + OTHERS };
        NormalEquations<ALL> equations;
        const FlowResidual::Values values(m.at.data());
        rsackermann::addPoints<ALL>(
            bearings, pointWeights, 1, dependence,
            [&](const TrackedBearing& s, Eigen::Matrix<double, ALL, 2>& J) {
                FlowGradient byValues;
                const Point2d r = residual.evaluate(s, values, byValues.data());
                // In an interval that is longer a slower car has gone as far.
                const Eigen::RowVector2d byInterval = m.at[SEQUENCE_YAW_RATE] * byValues.row(SEQUENCE_YAW_RATE) +
                                                      m.at[SEQUENCE_SPEED] * byValues.row(SEQUENCE_SPEED);
                const bool isBefore = s.pitch == FLOW_PITCH_BEFORE;
                J << byValues, s.timeNow * unit * byValues.middleRows<TURNS>(FLOW_PITCH_BEFORE), isBefore * byInterval,
                    !isBefore * byInterval;
                return r;
            },
            equations);
        // All of them in standard deviations, which may be 0.
        typedef Eigen::Matrix<double, OTHERS, OTHERS> OtherMatrix;
        typedef Eigen::Matrix<double, OTHERS, 1> OtherVector;
        const OtherVector sigmas = (OtherVector() << nuisances.pitchChange, nuisances.rollChange, nuisances.pitchChange,
                                    nuisances.rollChange, nuisances.interval, nuisances.interval)
                                       .finished();
        const FlowEquations::Matrix P = scaledInverse(m.equations.symmetric());
        const Eigen::Matrix<double, OTHERS, FLOW_VALUES> C =
            sigmas.asDiagonal() * equations.information.bottomLeftCorner<OTHERS, FLOW_VALUES>();
        OtherMatrix D = equations.symmetric().bottomRightCorner<OTHERS, OTHERS>();
        D = sigmas.asDiagonal() * D * sigmas.asDiagonal();
        const Eigen::Matrix<double, FLOW_VALUES, OTHERS> PC = P * C.transpose();
        const OtherMatrix K = scaledInverse<OtherMatrix>(OtherMatrix::Identity() + D - C * PC);
        const Eigen::Matrix<double, FLOW_VALUES, OTHERS> gain = PC * K;
        const OtherVector gradient = sigmas.cwiseProduct(equations.gradient.tail<OTHERS>());
        const Unknowns x = m.at + gain * gradient;
        const FlowEquations::Matrix covariance = P + gain * PC.transpose();
        std::copy(x.data(), x.data() + SEQUENCE_VALUES, state.value.val);
        for (int i = SEQUENCE_LEFT; i <= SEQUENCE_ROAD; i++)
            state.value[i] = std::max(state.value[i], 0.);
        Eigen::Map<StateMatrix>(state.covariance.val) =
            covariance.topLeftCorner<SEQUENCE_VALUES, SEQUENCE_VALUES>().transpose();
    }

    // The predicted state depends on the camera's values, too. Sets by how much that of the minimum does.
    CameraEvidence measureCamera(const Minimum& m, const FitNuisances& nuisances, SequenceState& state) const
    {
        const FlowResidual turned(camera.heading + HEADING_STEP, unit, focal);
        const FlowResidual::Values values(m.at.data());
        CameraEquations others;
        rsackermann::addPoints<FLOW_VALUES + CAMERA_VALUES>(
            bearings, pointWeights, 1, dependence,
            [&](const TrackedBearing& s, Eigen::Matrix<double, FLOW_VALUES + CAMERA_VALUES, 2>& J) {
                FlowGradient byValues;
                const Point2d r = residual.evaluate(s, values, byValues.data()), t = turned.evaluate(s, values, 0),
                              change = FlowResidual::isBehind(t) ? Point2d() : (t - r) * (1 / HEADING_STEP);
                J << byValues, Eigen::RowVector2d::Zero(), Eigen::RowVector2d(change.x, change.y),
                    nuisances.curvature * Eigen::RowVector2d(change.x, change.y);
                return r;
            },
            others);
        CameraJacobian byCamera = CameraJacobian::Zero();
        byCamera.topRows<SEQUENCE_VALUES>() = Eigen::Map<const StateByCamera>(state.byCamera.val);
        const CameraJacobian weighed = prior * byCamera;
        others.information.topLeftCorner<FLOW_VALUES, FLOW_VALUES>() += prior;
        others.information.bottomLeftCorner<CAMERA_VALUES, FLOW_VALUES>() -= weighed.transpose();
        others.information.bottomRightCorner<CAMERA_VALUES, CAMERA_VALUES>() += weighed.transpose() * byCamera;
        others.gradient.head<FLOW_VALUES>() += prior * (m.at - expected);
        others.gradient.tail<CAMERA_VALUES>() -= weighed.transpose() * (m.at - expected);
        SequenceState minimum = state; // without what the frame's nuisances change
        std::copy(m.at.data(), m.at.data() + SEQUENCE_VALUES, minimum.value.val);
        const CameraEvidence evidence = rsackermann::measureCamera(
            camera, verticals, weightsByPoints(m.at), others, nuisances.readoutRatio, nuisances.curvature, minimum);
        state.byCamera = minimum.byCamera;
        return evidence;
    }

    const std::vector<TrackedBearing>& bearings;
    const FlowResidual residual;
    Unknowns expected = Unknowns::Zero();

private:
    // Verticals of what moves otherwise don't lean as the scene's do: each counts as the point next to it.
    std::vector<double> weightsByPoints(const Unknowns& u) const
    {
        const CauchyLoss loss(1);
        const FlowResidual::Values values(u.data());
        std::vector<double> ofPoints;
        for (size_t i = 0; i < bearings.size(); i++)
        {
            const Point2d r = residual.evaluate(bearings[i], values, 0), weighed(pointWeights[i] * Vec2d(r.x, r.y));
            ofPoints.push_back(loss.slope(weighed.dot(weighed)));
        }
        std::vector<double> weights;
        for (const UprightSegment& s : verticals)
        {
            const Vec3d middle = (s.u + s.v) / 2;
            double nearest = DBL_MAX, weight = 1;
            for (size_t i = 0; i < bearings.size(); i++)
            {
                const Point2d away = bearings[i].now - Point2d(middle[0], middle[1]);
                if (away.dot(away) < nearest)
                {
                    nearest = away.dot(away);
                    weight = ofPoints[i];
                }
            }
            weights.push_back(weight);
        }
        return weights;
    }

    void addPoints(const Unknowns& u, FlowEquations& equations) const
    {
        const FlowResidual::Values values(u.data());
        rsackermann::addPoints<FLOW_VALUES>(
            bearings, pointWeights, scale, dependence,
            [&](const TrackedBearing& s, FlowGradient& J) { return residual.evaluate(s, values, J.data()); },
            equations);
    }

    void addVerticals(const Unknowns& u, FlowEquations& equations) const
    {
        typedef NormalEquations<PARAMETERS> ModelEquations;
        Matx<double, PARAMETERS, SEQUENCE_VALUES> byValues;
        const PreparedModel model(toModel(SequenceVector(u.data()), unit, &byValues), camera.heading);
        // Summed in the parameters of a model first, of which there are fewer.
        ModelEquations sums;
        rsackermann::addVerticals<PARAMETERS>(
            verticals, slantWeights, SLANT_SCALE,
            [&](const UprightSegment& c, Eigen::Matrix<double, PARAMETERS, 1>& J) {
                return slantInSigmas(c, model, focal, J.data());
            },
            sums);
        const Eigen::Map<Eigen::Matrix<double, SEQUENCE_VALUES, PARAMETERS>> J(byValues.val);
        equations.cost += sums.cost;
        equations.gradient.head<SEQUENCE_VALUES>() += J * sums.gradient;
        const Eigen::Matrix<double, SEQUENCE_VALUES, PARAMETERS> weighed = J * sums.symmetric();
        equations.information.topLeftCorner<SEQUENCE_VALUES, SEQUENCE_VALUES>() += weighed * J.transpose();
    }

    const RollingShutterCamera& camera;
    const std::vector<UprightSegment>& verticals;
    std::vector<Matx22d> pointWeights;
    std::vector<double> slantWeights;
    double unit, focal, scale;      // scale: of the points' loss, in sigmas
    double dependence = DEPENDENCE; // of points
    FlowEquations::Matrix prior;
};

// Returns the share of all points that agree.
double expect(const FrameFitProblem& problem, const Unknowns& u, double focal, SequenceFit& fit)
{
    ResidualShare share;
    const FlowResidual::Values values(u.data());
    for (const TrackedBearing& s : problem.bearings)
        share.add(s, norm(problem.residual.evaluate(s, values, 0)), focal);
    fit.agreeing = share.count > 0 ? double(share.count) / double(share.count + share.others) : 0;
    fit.residual = share.value();
    // A motion has to explain more than its unknowns would by chance.
    const int unknowns = 6;
    Unknowns still = u;
    still[SEQUENCE_YAW_RATE] = still[SEQUENCE_SPEED] = 0;
    const double ofStill = problem.pointCost(still);
    fit.moves = ofStill - problem.pointCost(u) > 2 * unknowns;
    Unknowns predicted = u;
    predicted.head<SEQUENCE_VALUES>() = problem.expected.head<SEQUENCE_VALUES>();
    fit.stands = !fit.moves && problem.pointCost(predicted) - ofStill > 2 * unknowns;
    return problem.bearings.empty() ? 0 : double(share.count) / double(problem.bearings.size());
}

// From the predicted state and, if that tells little or its neighbourhood explains little, from other motions.
Minimum search(FrameFitProblem& problem, double focal, bool isUninitialised, SequenceFit& fit)
{
    const double enough = 0.5; // of the points agree
    const Unknowns& u = problem.expected;
    Minimum best = problem.refine(u, true);
    if (!isUninitialised)
    {
        // What doesn't move with the scene may lead astray from where it was.
        const Minimum nearby = problem.refine(u, false);
        if (nearby.equations.cost < best.equations.cost)
            best = nearby;
    }
    const double share = expect(problem, best.at, focal, fit);
    if (isUninitialised || share < enough)
    {
        const double speeds[] = {0, 10, 10, -3}, walls[] = {0.1, 0.2, 0.08, 0.1}; // m/s, 1/m
        for (int i = 0; i < 4; i++)
        {
            Unknowns start = u;
            start[SEQUENCE_SPEED] = speeds[i];
            start[SEQUENCE_LEFT] = start[SEQUENCE_RIGHT] = walls[i];
            const Minimum other = problem.refine(start, true);
            if (other.equations.cost < best.equations.cost)
                best = other;
        }
        expect(problem, best.at, focal, fit);
    }
    return best;
}

// The motion next to rest. Something large that passes a car at rest looks like a wall that a car passes backward, and
// the road like its bonnet; something that is nearer looks like a bend, and the street like the car itself. Returns
// whether most points agree.
bool findRest(FrameFitProblem& problem, double focal, SequenceFit& fit, Minimum& rest)
{
    Unknowns start = problem.expected;
    start[SEQUENCE_YAW_RATE] = start[SEQUENCE_SPEED] = 0;
    start[SEQUENCE_LEFT] = start[SEQUENCE_RIGHT] = 0.1; // 1/m
    rest = problem.refine(start, false);
    return expect(problem, rest.at, focal, fit) > 0.5;
}

// A minimum as the fit of a frame.
SequenceFit toFit(FrameFitProblem& problem, Minimum best, const FitNuisances& nuisances, SequenceFit fit)
{
    problem.refineWithNoise(best);
    std::copy(best.at.data(), best.at.data() + FLOW_VALUES, fit.values);
    problem.measureTurns(best.at, fit.before, fit.after);
    fit.camera = problem.measureCamera(best, nuisances, fit.state);
    problem.countTogether(best);
    problem.setState(best, nuisances, fit.state);
    fit.yawGrowthSigma = nuisances.yawGrowth;
    return fit;
}

} // namespace

SequenceFit fitFrame(const RollingShutterCamera& camera, const std::vector<TrackedBearing>& bearings,
                     const std::vector<UprightSegment>& verticals, const SequenceState& prediction,
                     bool isUninitialised, const FitNuisances& nuisances)
{
    const double focal = camera.cameraMatrix(0, 0);
    FrameFitProblem problem(camera, bearings, verticals, prediction, nuisances.yawGrowth);
    SequenceFit fit(prediction), other(prediction);
    const Minimum best = search(problem, focal, isUninitialised, fit);
    Minimum rest;
    if ((best.at[SEQUENCE_SPEED] < 0 || problem.hidesScene(best.at)) && findRest(problem, focal, other, rest))
        return toFit(problem, rest, nuisances, other);
    double cost;
    const std::vector<TrackedBearing> above = aboveOwnCar(bearings, focal, cost);
    if (fit.moves && above.size() < bearings.size() && above.size() >= LEAST_POINTS)
    {
        FrameFitProblem ofScene(camera, above, verticals, prediction, nuisances.yawGrowth);
        const Minimum scene = search(ofScene, focal, isUninitialised, other);
        if (scene.equations.cost + cost < best.equations.cost)
            return toFit(ofScene, scene, nuisances, other);
    }
    return toFit(problem, best, nuisances, fit);
}

}} // namespace cv::rsackermann
