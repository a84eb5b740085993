// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../optim/levenberg_marquardt.hpp"
#include "../sequence/frame_terms.hpp"
#include "../sequence/row_rates.hpp"
#include "mount_equations.hpp"
#include "mount_solver.hpp"
#include <Eigen/LU>

namespace cv { namespace rsackermann {

// By which the change of a tilt differs from the turn between two frames. These differences add up, so that a larger
// one lets tilts follow the yaw rate like a line delay.
static const double SAME_TURN = 0.005 * CV_PI / 180;
// Relative, of the line delays that turning and passing show: scenes that aren't plane make more of it than noise does
static const double SAME_DELAY = 0.03;

namespace {

// Tilts and what they are of the mount
const int TILTS[] = {LINKED_ROLL, LINKED_PITCH}, MOUNTS[] = {MOUNT_ROLL, MOUNT_PITCH};
// What of each frame scatters: both tilts, and its score, the gradient by the mount.
enum { SERIES_VALUES = 2 + MOUNT_VALUES };
typedef Eigen::Matrix<double, SERIES_VALUES, 1> SeriesVector;
typedef Eigen::Matrix<double, SERIES_VALUES, SERIES_VALUES> SeriesMatrix;

class MountProblem
{
public:
    typedef MountState State;
    typedef MountState Step;
    typedef MountEquations Equations;

    MountProblem(const RollingShutterCamera& camera_, std::vector<CalibrationFrame>& frames_, const MountVector& sigma_,
                 const Suspension& suspension_)
        : camera(camera_), frames(frames_), sigma(sigma_), suspension(suspension_),
          mount(MountVector::Zero()), sigmas{1, 1, 1}, scale(1)
    {
    }

    void refine(double scale_)
    {
        scale = scale_;
        const FrameProblem problem(camera, mount, scale, sigmas);
        MountState state = {mount, std::vector<FrameVector>()};
        for (size_t k = 0; k < frames.size(); k++)
        {
            problem.weigh(frames[k]);
            state.frames.push_back(frames[k].value);
        }
        minimize(*this, MinimizerOptions(STEPS, 1e-5 * double(frames.size())), state, equations);
        mount = state.mount;
        for (size_t k = 0; k < frames.size(); k++)
            frames[k].value = state.frames[k];
    }

    void evaluate(const MountState& state, MountEquations& result) const
    {
        const FrameProblem problem(camera, state.mount, scale, sigmas);
        result.prior = prior();
        result.priorGradient = result.prior * state.mount;
        result.cost = state.mount.dot(result.priorGradient);
        result.frames.clear();
        result.terms.clear();
        for (size_t k = 0; k < frames.size(); k++)
        {
            result.frames.push_back(problem.evaluate(frames[k], state.frames[k]));
            result.cost += result.frames[k].cost;
            addTermsOf(k, state, result.terms);
        }
        for (size_t i = 0; i < result.terms.size(); i++)
            result.cost += result.terms[i].value * result.terms[i].value;
    }

    static MountState moved(MountState state, const MountState& step)
    {
        state.mount += step.mount;
        for (size_t k = 0; k < state.frames.size(); k++)
        {
            state.frames[k] += step.frames[k];
            for (int i = SEQUENCE_LEFT; i <= SEQUENCE_ROAD; i++)
                state.frames[k][i] = std::max(state.frames[k][i], 0.);
        }
        return state;
    }

    static bool allows(const MountState&) { return true; }

    // How much points and verticals of this drive really err.
    void updateSigmas()
    {
        const FrameProblem problem(camera, mount, 1, sigmas);
        PointResiduals residuals;
        std::vector<UncertainResidual> slants;
        for (size_t k = 0; k < frames.size(); k++)
        {
            problem.addPointResiduals(frames[k], residuals);
            problem.addSlantResiduals(frames[k], slants);
        }
        const PointNoise noise = residuals.noise(FLT_EPSILON);
        sigmas.points = noise.points;
        sigmas.depths = noise.depths;
        sigmas.slants =
            solveScale(slants, [&](double slant, double by) { return std::hypot(slant, sigmas.depths * by); });
    }

    MountFit result() const
    {
        const ReducedMount reduced(equations);
        const MountMatrix inverse = scaledInverse(reduced.information);
        const SeriesMatrix scatter = scatterOfMeans(reduced.scores());
        // The information of the weights joins what the frames show as some more frames would.
        const double more = ASSUMED_FRAMES / (double(frames.size()) + ASSUMED_FRAMES);
        const MountMatrix ofScores = (1 - more) * scatter.bottomRightCorner<MOUNT_VALUES, MOUNT_VALUES>() +
                                     more * (reduced.information - prior());
        MountFit fit;
        fit.value = mount;
        fit.sigma = MountMatrix(inverse * (ofScores + prior()) * inverse).diagonal().cwiseSqrt();
        fit.turningSigma =
            std::sqrt(scaledInverse<MountMatrix>(reduced.information - sameDelay())(MOUNT_DELAY, MOUNT_DELAY));
        fit.weightsSigma = std::sqrt(inverse(MOUNT_DELAY, MOUNT_DELAY));
        takeMeanTilts(scatter, reduced.linkedByMount(), inverse, fit);
        return fit;
    }

private:
    MountMatrix prior() const
    {
        MountMatrix information = sigma.cwiseProduct(sigma).cwiseInverse().asDiagonal();
        return information + sameDelay();
    }

    // It is one line delay that turning and passing show.
    static MountMatrix sameDelay()
    {
        MountVector difference = MountVector::Zero();
        difference[MOUNT_DELAY] = 1 / SAME_DELAY;
        difference[MOUNT_PASSING] = -1 / SAME_DELAY;
        return difference * difference.transpose();
    }

    // Seconds since the frame before in the list; ages if that is of another drive.
    double passedBefore(size_t k) const
    {
        const bool isFirst = k == 0 || frames[k].drive != frames[k - 1].drive;
        return isFirst ? DBL_MAX : frames[k].time - frames[k - 1].time;
    }

    // The connections of a frame with the one before and with the mount.
    void addTermsOf(size_t k, const MountState& state, std::vector<LinearTerm>& terms) const
    {
        static const int turns[] = {LINKED_ROLL_TURN, LINKED_PITCH_TURN};
        const FrameVector& now = state.frames[k];
        const double passed = passedBefore(k);
        const bool follows = k > 0 && frames[k].follows(frames[k - 1]);
        // Of a turn that the points show counts what the suspension says of the mount alone: it would hold back the
        // turn where something shakes faster than cars do.
        const double kept = follows ? 0 : std::exp(-passed / suspension.memory),
                     variance = follows ? 1 / std::tanh(passed / (2 * suspension.memory))
                                        : -std::expm1(-2 * passed / suspension.memory),
                     inverse = 1 / (suspension.sigma * std::sqrt(variance));
        for (int i = 0; i < 2; i++)
        {
            const double m = state.mount[MOUNTS[i]], a = now[SCENE_VALUES + TILTS[i]],
                         b = k > 0 ? state.frames[k - 1][SCENE_VALUES + TILTS[i]] : m;
            LinearTerm tilt(k, inverse * (a - m - kept * (b - m)));
            tilt.by(unknownOf(k, TILTS[i]), inverse);
            if (k > 0)
                tilt.by(unknownOf(k - 1, TILTS[i]), -kept * inverse);
            tilt.by(~MOUNTS[i], (kept - 1) * inverse);
            terms.push_back(tilt);
            if (!follows)
                continue;
            LinearTerm turn(k, (a - b - now[SCENE_VALUES + turns[i]]) / SAME_TURN);
            turn.by(unknownOf(k, TILTS[i]), 1 / SAME_TURN);
            turn.by(unknownOf(k - 1, TILTS[i]), -1 / SAME_TURN);
            turn.by(unknownOf(k, turns[i]), -1 / SAME_TURN);
            terms.push_back(turn);
        }
    }

    // The tilts that a frame shows.
    Eigen::Vector2d tilts(size_t k) const
    {
        return Eigen::Vector2d(frames[k].value[SEQUENCE_ROLL], frames[k].value[SEQUENCE_PITCH]);
    }

    // Of the mean tilts and of the sum of all scores.
    SeriesMatrix scatterOfMeans(const std::vector<MountVector>& score) const
    {
        const double n = double(frames.size());
        std::vector<SeriesVector> series(frames.size());
        for (size_t k = 0; k < frames.size(); k++)
            series[k] << tilts(k) / n, score[k];
        SeriesVector memories = SeriesVector::Zero();
        memories.head<2 + 2>().setConstant(suspension.memory); // the same tilts are in its scores
        memories[2 + MOUNT_HEADING] = memories[2 + MOUNT_LEVER] = MEMORY[SEQUENCE_DIRECTION];
        return hacCovariance(series, seconds(), memories);
    }

    double seconds() const
    {
        double sum = 0;
        for (size_t k = 0; k < frames.size(); k++)
            sum += frames[k].interval;
        return sum;
    }

    /* The mount's roll and pitch are the means of what the frames show. By the suspension's assumed memory frames at
    the ends would count more; the mean is nearly as good if cars sway like that, and doesn't rest on it.
    @param inverse of the mount's information. */
    void takeMeanTilts(const SeriesMatrix& scatter,
                       const Eigen::Matrix<double, Eigen::Dynamic, MOUNT_VALUES>& linkedByMount,
                       const MountMatrix& inverse, MountFit& fit) const
    {
        const double n = double(frames.size());
        Eigen::Vector2d mean(0, 0);
        Eigen::Matrix<double, 2, MOUNT_VALUES> byMount = Eigen::Matrix<double, 2, MOUNT_VALUES>::Zero();
        for (size_t k = 0; k < frames.size(); k++)
        {
            mean += tilts(k) / n;
            for (int i = 0; i < 2; i++)
                byMount.row(i) -= linkedByMount.row(unknownOf(k, TILTS[i])) / n;
        }
        // Tilts that frames don't show are those of the mount, and all of them follow heading and line delay: what
        // moves these moves the mean as well, beside what a frame's tilt itself does to it.
        const Eigen::Matrix<double, 2, MOUNT_VALUES> byScores = byMount * inverse;
        Eigen::Matrix<double, 2, SERIES_VALUES> bySeries;
        bySeries << Eigen::Matrix2d::Identity(), -byScores;
        const Eigen::Matrix2d covariance =
            bySeries * scatter * bySeries.transpose() + byScores * prior() * byScores.transpose();
        for (int i = 0; i < 2; i++)
        {
            fit.value[MOUNTS[i]] = mean[i];
            fit.sigma[MOUNTS[i]] = std::sqrt(covariance(i, i));
        }
    }

    const RollingShutterCamera& camera;
    std::vector<CalibrationFrame>& frames;
    const MountVector sigma;
    const Suspension suspension;
    MountVector mount;
    ResidualSigmas sigmas;
    double scale;             // of the points' loss
    MountEquations equations; // of the last refinement, at its result
};

} // namespace

MountFit fitMount(const RollingShutterCamera& camera, std::vector<CalibrationFrame>& frames, const MountVector& sigma,
                  const Suspension& suspension)
{
    MountProblem problem(camera, frames, sigma, suspension);
    problem.refine(3);
    problem.refine(1);
    problem.updateSigmas();
    problem.refine(2);
    return problem.result();
}

}} // namespace cv::rsackermann
