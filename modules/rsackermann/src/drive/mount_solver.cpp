// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "mount_solver.hpp"
#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace cv { namespace rsackermann {

static const int ITERATIONS = 8; // at each scale
// By which the change of a tilt differs from the turn between two frames. These differences add up, so that a larger
// one lets tilts follow the yaw rate like a line delay.
static const double SAME_TURN = 0.005 * CV_PI / 180;
// rad/s^2: a drive that tells the line delay weaves, and many frames tell the change
static const double LARGE_YAW_CHANGE_SIGMA = 10 * CV_PI / 180;
static const double YAW_CHANGE_MEMORY = 0.5; // seconds
static const double SAME_TIME = 1e-6;        // seconds, as times are rounded
// Relative, of the line delays that turning and passing show: scenes that aren't plane make more of it than noise does
static const double SAME_DELAY = 0.01;
// Seconds: cars slip and streets bend, so that the direction in which a car goes wanders
static const double DIRECTION_MEMORY = 1;
static const double ASSUMED_FRAMES = 3; // as many count as the weights say
static const double MEDIAN = 0.67;      // of a normal distribution's absolute value, in sigmas
// Of residuals, over the usual ones: points are tracked to some hundredths of a pixel at best
static const double LEAST_POINT_SIGMA = 0.03, LEAST_SLANT_SIGMA = 0.15;

namespace {

typedef Eigen::Matrix<double, Eigen::Dynamic, 1> Vector;
typedef Eigen::Matrix<double, Eigen::Dynamic, MOUNT_VALUES> ByMount;
typedef Eigen::SparseMatrix<double> Sparse;
// What of each frame scatters: both tilts, and its pulls at the mount.
enum { SERIES_VALUES = 2 + MOUNT_VALUES };
typedef Eigen::Matrix<double, SERIES_VALUES, 1> SeriesVector;
typedef Eigen::Matrix<double, SERIES_VALUES, SERIES_VALUES> SeriesMatrix;

// A residual in sigmas that is linear in a few unknowns: linked values of frames, and the mount.
struct LinearTerm
{
    double value;
    int count, unknown[4]; // those below 0 are ~MountValue
    double slope[4];

    explicit LinearTerm(double v) : value(v), count(0) {}
    void by(int which, double s)
    {
        unknown[count] = which;
        slope[count++] = s;
    }
};

class MountProblem
{
public:
    MountProblem(const RollingShutterCamera& camera_, std::vector<CalibrationFrame>& frames_, const MountVector& sigma_,
                 const Suspension& suspension_)
        : camera(camera_), frames(frames_), sigma(sigma_), suspension(suspension_),
          mount(MountVector::Zero()), sigmas{1, 1, 1}
    {
    }

    void refine(double scale)
    {
        const FrameProblem problem(camera, mount, scale, sigmas);
        for (size_t k = 0; k < frames.size(); k++)
            problem.weigh(frames[k]);
        double least = cost(scale);
        for (int i = 0; i < ITERATIONS && step(scale, least); i++)
            ;
    }

    // How much points and verticals of this drive really err.
    void learnSigmas()
    {
        const FrameProblem problem(camera, mount, 1, sigmas);
        std::vector<double> across;
        std::vector<DepthResidual> along, slants;
        for (size_t k = 0; k < frames.size(); k++)
        {
            problem.addMisses(frames[k], across, along);
            problem.addSlants(frames[k], slants);
        }
        if (!across.empty())
            sigmas.points = std::min(std::max(median(across) / (MEDIAN * POINT_SIGMA), LEAST_POINT_SIGMA), 1.);
        sigmas.depths = learn(
            along, 0, [&](double depths, double by) { return std::hypot(POINT_SIGMA * sigmas.points, depths * by); });
        sigmas.slants = learn(slants, LEAST_SLANT_SIGMA,
                              [&](double slant, double by) { return std::hypot(slant, sigmas.depths * by); });
    }

    MountFit result(double scale)
    {
        linearize(scale);
        const MountMatrix inverse = reduced.inverse();
        const SeriesMatrix scatter = slowScatter();
        // The information of the weights joins what the frames show as some more frames would.
        const double more = ASSUMED_FRAMES / (double(frames.size()) + ASSUMED_FRAMES);
        const MountMatrix ofPulls =
            (1 - more) * scatter.bottomRightCorner<MOUNT_VALUES, MOUNT_VALUES>() + more * (reduced - prior());
        MountFit fit;
        fit.value = mount;
        fit.sigma = MountMatrix(inverse * (ofPulls + prior()) * inverse).diagonal().cwiseSqrt();
        fit.turningSigma = std::sqrt(MountMatrix((reduced - sameDelay()).inverse())(MOUNT_DELAY, MOUNT_DELAY));
        takeMeanTilts(scatter, inverse, fit);
        return fit;
    }

private:
    static double median(std::vector<double>& values)
    {
        std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
        return values[values.size() / 2];
    }

    // The value up to 1 with which residuals have the median of a normal distribution of the standard deviations
    // sigmaOf(value, byDepth), which grow with it.
    template <class SigmaOf>
    static double learn(const std::vector<DepthResidual>& residuals, double least, const SigmaOf& sigmaOf)
    {
        const int halvings = 10;
        double low = least, high = 1;
        std::vector<double> values(residuals.size());
        for (int i = 0; i < halvings && !residuals.empty(); i++)
        {
            const double middle = (low + high) / 2;
            for (size_t k = 0; k < residuals.size(); k++)
                values[k] = residuals[k].value / sigmaOf(middle, residuals[k].byDepth);
            (median(values) > MEDIAN ? low : high) = middle;
        }
        return high;
    }

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

    static int unknownOf(size_t frame, int linked) { return int(frame) * LINKED_VALUES + linked; }

    // Seconds since the frame before in the list; ages if that is of another drive.
    double passedBefore(size_t k) const
    {
        const bool isFirst = k == 0 || frames[k].drive != frames[k - 1].drive;
        return isFirst ? DBL_MAX : std::max(frames[k].time - frames[k - 1].time, SAME_TIME);
    }

    // The connections of a frame with the one before and with the mount.
    void termsOf(size_t k, std::vector<LinearTerm>& terms) const
    {
        static const int tilts[] = {FrameEquations::ROLL, FrameEquations::PITCH},
                         turns[] = {FrameEquations::ROLL_TURN, FrameEquations::PITCH_TURN};
        static const int mounts[] = {MOUNT_ROLL, MOUNT_PITCH};
        terms.clear();
        const FrameVector& now = frames[k].value;
        const double passed = passedBefore(k);
        const double kept = std::exp(-passed / suspension.memory);
        const bool follows = passed < frames[k].interval + SAME_TIME;
        terms.push_back(yawChangeTerm(k, passed));
        for (int i = 0; i < 2; i++)
        {
            const double m = mount[mounts[i]], a = now[SCENE_VALUES + tilts[i]],
                         b = k > 0 ? frames[k - 1].value[SCENE_VALUES + tilts[i]] : m;
            const double inverse = 1 / (suspension.sigma * std::sqrt(1 - kept * kept));
            LinearTerm tilt(inverse * (a - m - kept * (b - m)));
            tilt.by(unknownOf(k, tilts[i]), inverse);
            if (k > 0)
                tilt.by(unknownOf(k - 1, tilts[i]), -kept * inverse);
            tilt.by(~mounts[i], (kept - 1) * inverse);
            terms.push_back(tilt);
            if (!follows)
                continue;
            LinearTerm turn((a - b - now[SCENE_VALUES + turns[i]]) / SAME_TURN);
            turn.by(unknownOf(k, tilts[i]), 1 / SAME_TURN);
            turn.by(unknownOf(k - 1, tilts[i]), -1 / SAME_TURN);
            turn.by(unknownOf(k, turns[i]), -1 / SAME_TURN);
            terms.push_back(turn);
        }
    }

    // The change of the yaw rate doesn't jump.
    LinearTerm yawChangeTerm(size_t k, double passed) const
    {
        const int which = FrameEquations::YAW_CHANGE;
        const double kept = std::exp(-passed / YAW_CHANGE_MEMORY),
                     inverse = 1 / (LARGE_YAW_CHANGE_SIGMA * std::sqrt(1 - kept * kept));
        const double before = k > 0 ? frames[k - 1].value[SCENE_VALUES + which] : 0;
        LinearTerm term(inverse * (frames[k].value[SCENE_VALUES + which] - kept * before));
        term.by(unknownOf(k, which), inverse);
        if (k > 0)
            term.by(unknownOf(k - 1, which), -kept * inverse);
        return term;
    }

    double cost(double scale) const
    {
        const FrameProblem problem(camera, mount, scale, sigmas);
        double sum = mount.dot(prior() * mount);
        std::vector<LinearTerm> terms;
        for (size_t k = 0; k < frames.size(); k++)
        {
            sum += problem.cost(frames[k]);
            termsOf(k, terms);
            for (size_t i = 0; i < terms.size(); i++)
                sum += terms[i].value * terms[i].value;
        }
        return sum;
    }

    // Normal equations, with the values of the frames eliminated.
    void linearize(double scale)
    {
        const int unknowns = unknownOf(frames.size(), 0);
        const FrameProblem problem(camera, mount, scale, sigmas);
        std::vector<Eigen::Triplet<double>> entries;
        Vector gradient = Vector::Zero(unknowns);
        ByMount mixed = ByMount::Zero(unknowns, int(MOUNT_VALUES));
        MountMatrix information = prior();
        mountGradient = prior() * mount;
        equations.resize(frames.size());
        std::vector<LinearTerm> terms;
        for (size_t k = 0; k < frames.size(); k++)
        {
            FrameEquations& e = equations[k];
            e = problem.equations(frames[k]);
            const int at = unknownOf(k, 0);
            for (int i = 0; i < LINKED_VALUES; i++)
                for (int j = 0; j < LINKED_VALUES; j++)
                    entries.push_back(Eigen::Triplet<double>(at + i, at + j, e.information(i, j)));
            gradient.segment<LINKED_VALUES>(at) += e.gradient.head<LINKED_VALUES>();
            mixed.block<LINKED_VALUES, SHARED_VALUES>(at, MOUNT_HEADING) +=
                e.information.topRightCorner<LINKED_VALUES, SHARED_VALUES>();
            information.bottomRightCorner<SHARED_VALUES, SHARED_VALUES>() +=
                e.information.bottomRightCorner<SHARED_VALUES, SHARED_VALUES>();
            mountGradient.tail<SHARED_VALUES>() += e.gradient.tail<SHARED_VALUES>();
            termsOf(k, terms);
            for (size_t t = 0; t < terms.size(); t++)
                add(terms[t], entries, gradient, mixed, information);
        }
        Sparse locals(unknowns, unknowns);
        locals.setFromTriplets(entries.begin(), entries.end());
        const Eigen::SimplicialLDLT<Sparse> solver(locals);
        localByMount = solver.solve(mixed);
        local = solver.solve(gradient);
        reduced = information - mixed.transpose() * localByMount;
        mountGradient -= mixed.transpose() * local;
    }

    void add(const LinearTerm& term, std::vector<Eigen::Triplet<double>>& entries, Vector& gradient, ByMount& mixed,
             MountMatrix& information)
    {
        for (int i = 0; i < term.count; i++)
        {
            const int a = term.unknown[i];
            if (a < 0)
                mountGradient[~a] += term.slope[i] * term.value;
            else
                gradient[a] += term.slope[i] * term.value;
            for (int j = 0; j < term.count; j++)
            {
                const int b = term.unknown[j];
                const double product = term.slope[i] * term.slope[j];
                if (a >= 0 && b >= 0)
                    entries.push_back(Eigen::Triplet<double>(a, b, product));
                else if (a >= 0)
                    mixed(a, ~b) += product;
                else if (b < 0)
                    information(~a, ~b) += product;
            }
        }
    }

    // Returns whether there is more to be gained.
    bool step(double scale, double& least)
    {
        const double enough = 1e-4 * double(frames.size());
        const int halvings = 5;
        linearize(scale);
        const MountVector change = -reduced.ldlt().solve(mountGradient), before = mount;
        const Vector localChange = -local - localByMount * change;
        std::vector<FrameVector> values, changes;
        for (size_t k = 0; k < frames.size(); k++)
        {
            FrameEquations::Vector others;
            others << localChange.segment<LINKED_VALUES>(unknownOf(k, 0)), change.tail<SHARED_VALUES>();
            FrameVector v;
            v << equations[k].sceneChange(others), others.head<LINKED_VALUES>();
            changes.push_back(v);
            values.push_back(frames[k].value);
        }
        double size = 1;
        for (int half = 0; half < halvings; half++, size *= 0.5)
        {
            mount = before + size * change;
            for (size_t k = 0; k < frames.size(); k++)
            {
                frames[k].value = values[k] + size * changes[k];
                for (int i = DRIVE_LEFT; i <= DRIVE_ROAD; i++)
                    frames[k].value[i] = std::max(frames[k].value[i], 0.);
            }
            const double after = cost(scale);
            if (!(after < least))
                continue;
            const bool isMore = least - after > enough;
            least = after;
            return isMore;
        }
        mount = before;
        for (size_t k = 0; k < frames.size(); k++)
            frames[k].value = values[k];
        return false;
    }

    // The contribution of each frame to the gradient of the mount, if the values of the frames follow.
    std::vector<MountVector> pulls() const
    {
        std::vector<MountVector> result;
        std::vector<LinearTerm> terms;
        for (size_t k = 0; k < frames.size(); k++)
        {
            const FrameEquations& e = equations[k];
            MountVector pull =
                -localByMount.middleRows<LINKED_VALUES>(unknownOf(k, 0)).transpose() * e.gradient.head<LINKED_VALUES>();
            pull.tail<SHARED_VALUES>() += e.gradient.tail<SHARED_VALUES>();
            termsOf(k, terms);
            for (size_t t = 0; t < terms.size(); t++)
                for (int i = 0; i < terms[t].count; i++)
                {
                    const int a = terms[t].unknown[i];
                    const double along = terms[t].slope[i] * terms[t].value;
                    if (a < 0)
                        pull[~a] += along;
                    else
                        pull -= along * localByMount.row(a).transpose();
                }
            result.push_back(pull);
        }
        return result;
    }

    // The tilts that a frame shows.
    Eigen::Vector2d tilts(size_t k) const
    {
        return Eigen::Vector2d(frames[k].value[DRIVE_ROLL], frames[k].value[DRIVE_PITCH]);
    }

    // Of the mean tilts and of the sum of all pulls.
    SeriesMatrix slowScatter() const
    {
        const std::vector<MountVector> pull = pulls();
        const double n = double(frames.size());
        std::vector<SeriesVector> series(frames.size());
        for (size_t k = 0; k < frames.size(); k++)
            series[k] << tilts(k) / n, pull[k];
        SeriesVector memories = SeriesVector::Zero();
        memories.head<2 + 2>().setConstant(suspension.memory); // the mount is pulled by the same tilts
        memories[2 + MOUNT_HEADING] = DIRECTION_MEMORY;
        return slowCovarianceOfSum(series, seconds(), memories);
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
    void takeMeanTilts(const SeriesMatrix& scatter, const MountMatrix& inverse, MountFit& fit) const
    {
        const double n = double(frames.size());
        const int which[] = {FrameEquations::ROLL, FrameEquations::PITCH};
        Eigen::Vector2d mean(0, 0);
        Eigen::Matrix<double, 2, MOUNT_VALUES> byMount = Eigen::Matrix<double, 2, MOUNT_VALUES>::Zero();
        for (size_t k = 0; k < frames.size(); k++)
        {
            mean += tilts(k) / n;
            for (int i = 0; i < 2; i++)
                byMount.row(i) -= localByMount.row(unknownOf(k, which[i])) / n;
        }
        // Tilts that frames don't show are those of the mount, and all of them follow heading and line delay: what
        // pulls these pulls the mean as well, beside what a frame's tilt itself does to it.
        const Eigen::Matrix<double, 2, MOUNT_VALUES> byPulls = byMount * inverse;
        Eigen::Matrix<double, 2, SERIES_VALUES> bySeries;
        bySeries << Eigen::Matrix2d::Identity(), -byPulls;
        const Eigen::Matrix2d covariance =
            bySeries * scatter * bySeries.transpose() + byPulls * prior() * byPulls.transpose();
        const int mounts[] = {MOUNT_ROLL, MOUNT_PITCH};
        for (int i = 0; i < 2; i++)
        {
            fit.value[mounts[i]] = mean[i];
            fit.sigma[mounts[i]] = std::sqrt(covariance(i, i));
        }
    }

    const RollingShutterCamera& camera;
    std::vector<CalibrationFrame>& frames;
    const MountVector sigma;
    const Suspension suspension;
    MountVector mount;
    ResidualSigmas sigmas;

    // of the last linearization
    std::vector<FrameEquations> equations;
    MountMatrix reduced;
    MountVector mountGradient;
    ByMount localByMount;
    Vector local;
};

} // namespace

MountFit fitMount(const RollingShutterCamera& camera, std::vector<CalibrationFrame>& frames, const MountVector& sigma,
                  const Suspension& suspension)
{
    const double LAST_SCALE = 2;
    MountProblem problem(camera, frames, sigma, suspension);
    problem.refine(3);
    problem.refine(1);
    problem.learnSigmas();
    problem.refine(LAST_SCALE);
    return problem.result(LAST_SCALE);
}

}} // namespace cv::rsackermann
