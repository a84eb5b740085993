// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_common.hpp"
#include "test_drive_simulator.hpp"
#include "../src/calibration/drive_turns.hpp"
#include "../src/calibration/mount_equations.hpp"
#include "../src/calibration/mount_solver.hpp"
#include "../src/factors/robust_losses.hpp"

// The equations of a calibration against the same ones written out, and what their solution keeps.

namespace opencv_test { namespace {

using simulation::StreetDrive;

const double INTERVAL = 1. / 30;

//! Of some frames, with random evidence and connections.
MountEquations randomEquations(int frames, RNG& rng)
{
    MountEquations e;
    e.cost = 0;
    Eigen::Matrix<double, FRAME_VALUES + SHARED_VALUES, 1> J;
    const auto number = [&]() { return rng.gaussian(1); };
    for (int k = 0; k < frames; k++)
    {
        FrameEquations frame;
        for (int i = 0; i < 20; i++)
        {
            J = J.NullaryExpr(number);
            frame.add(J, Eigen::Matrix<double, 1, 1>(number()), CauchyLoss(1, 1));
        }
        e.frames.push_back(frame);
        for (int i = 0; i < 5; i++)
        {
            LinearTerm term(k, number());
            term.by(unknownOf(k, i % LINKED_VALUES), number());
            if (k > 0)
                term.by(unknownOf(k - 1, (i + 1) % LINKED_VALUES), number());
            term.by(~i, number());
            e.terms.push_back(term);
        }
    }
    e.prior = MountMatrix::Identity() * 3;
    e.prior(0, 1) = e.prior(1, 0) = 0.7;
    e.priorGradient = MountVector::NullaryExpr(number);
    return e;
}

//! All unknowns: those of the frames, one after another, and the mount. @param only a frame, or -1 for all and what is
//! known of the mount.
void writeOut(const MountEquations& e, int only, Eigen::MatrixXd& information, Eigen::VectorXd& gradient)
{
    const int frames = int(e.frames.size()), mount = frames * FRAME_VALUES;
    information = Eigen::MatrixXd::Zero(mount + MOUNT_VALUES, mount + MOUNT_VALUES);
    gradient = Eigen::VectorXd::Zero(mount + MOUNT_VALUES);
    const auto placeOf = [&](int k, int i) {
        return i < FRAME_VALUES ? k * FRAME_VALUES + i : mount + MOUNT_HEADING + i - FRAME_VALUES;
    };
    const auto placeOfLinked = [&](int unknown) {
        return unknown < 0 ? mount + ~unknown
                           : unknown / LINKED_VALUES * FRAME_VALUES + SCENE_VALUES + unknown % LINKED_VALUES;
    };
    for (int k = 0; k < frames; k++)
        for (int i = 0; i < FRAME_VALUES + SHARED_VALUES && (only < 0 || only == k); i++)
        {
            gradient[placeOf(k, i)] += e.frames[k].gradient[i];
            for (int j = 0; j < FRAME_VALUES + SHARED_VALUES; j++)
                information(placeOf(k, i), placeOf(k, j)) += e.frames[k].information(std::max(i, j), std::min(i, j));
        }
    for (const LinearTerm& t : e.terms)
        for (int i = 0; i < t.count && (only < 0 || only == int(t.frame)); i++)
        {
            gradient[placeOfLinked(t.unknown[i])] += t.slope[i] * t.value;
            for (int j = 0; j < t.count; j++)
                information(placeOfLinked(t.unknown[i]), placeOfLinked(t.unknown[j])) += t.slope[i] * t.slope[j];
        }
    if (only >= 0)
        return;
    information.bottomRightCorner<MOUNT_VALUES, MOUNT_VALUES>() += e.prior;
    gradient.tail<MOUNT_VALUES>() += e.priorGradient;
}

TEST(RSAckermann_CalibrationEquations, elimination)
{
    RNG rng(1);
    for (int frames = 1; frames < 6; frames++)
    {
        const MountEquations e = randomEquations(frames, rng);
        const int own = frames * FRAME_VALUES;
        Eigen::MatrixXd H;
        Eigen::VectorXd g;
        for (const double damping : {0., 0.4})
        {
            writeOut(e, -1, H, g);
            H.diagonal() *= 1 + damping;
            const Eigen::VectorXd expected = -H.ldlt().solve(g);
            MountState step;
            EXPECT_NEAR(-expected.dot(g), e.solve(damping, step), 1e-9 * expected.norm() * g.norm());
            EXPECT_LT((step.mount - expected.tail<MOUNT_VALUES>()).norm(), 1e-9 * expected.norm());
            for (int k = 0; k < frames; k++)
                EXPECT_LT((step.frames[k] - expected.segment<FRAME_VALUES>(k * FRAME_VALUES)).norm(),
                          1e-9 * expected.norm());
        }
        writeOut(e, -1, H, g);
        const Eigen::MatrixXd byMount = H.topLeftCorner(own, own).ldlt().solve(H.topRightCorner(own, MOUNT_VALUES));
        const ReducedMount reduced(e);
        const MountMatrix information = H.bottomRightCorner<MOUNT_VALUES, MOUNT_VALUES>() -
                                        H.topRightCorner(own, MOUNT_VALUES).transpose() * byMount;
        EXPECT_LT((reduced.information - information).norm(), 1e-9 * information.norm());
        const std::vector<MountVector> scores = reduced.scores();
        for (int k = 0; k < frames; k++)
        {
            Eigen::MatrixXd ofFrame;
            writeOut(e, k, ofFrame, g);
            const MountVector score = g.tail<MOUNT_VALUES>() - byMount.transpose() * g.head(own);
            EXPECT_LT((scores[k] - score).norm(), 1e-9 * score.norm());
            for (int i = 0; i < LINKED_VALUES; i++)
                EXPECT_LT(
                    (reduced.linkedByMount().row(unknownOf(k, i)) - byMount.row(k * FRAME_VALUES + SCENE_VALUES + i))
                        .norm(),
                    1e-9 * byMount.norm());
        }
    }
}

struct Mode
{
    const char* name;
    double heading; // radians
    double referenceRow;
    bool hasGyro, shakes;
};

const Mode MODES[] = {{"forward", 0.02, 270, false, false},
                      {"looks half right", -0.75, 0, false, false},
                      {"shakes", 0.02, 20, false, true},
                      {"shakes with a gyro", 0.02, 500, true, true},
                      {"shakes with a gyro, looks half right", -0.75, 270, true, true}};

//! The frames of a drive as its points and verticals show them, from the camera as it is.
struct Recording
{
    Recording(const Mode& mode, int count)
        : camera(Size(960, 540), Matx33d(700, 0, 470, 0, 720, 280, 0, 0, 1)), suspension{0.4 * degree, 0.5},
          samples(std::make_shared<GyroSamples>())
    {
        camera.lineDelay = 0.025 / 540;
        camera.height = 1.4;
        camera.referenceRow = mode.referenceRow;
        camera.heading = mode.heading;
        camera.setRollPitch(0.02, -0.01);
        StreetDrive::Options options;
        options.rowsTurn = mode.shakes;
        options.tilt = (mode.shakes ? 0.5 : 0.1) * degree;
        options.sway = [](double size, RNG& rng) { return simulation::onArm(size, 1.5, rng); };
        options.noise = 0.01;
        options.outliers = options.clutter = 0;
        StreetDrive street(camera, 0.02, -0.01, options, 5);
        AckermannEstimator::Params params;
        params.gravitySigma = params.vehiclePitchSigma = 0.02;
        const SequenceState usual(camera, params);
        for (int k = 0; k < count; k++)
        {
            const StreetDrive::Frame f = street.frame(k * INTERVAL, INTERVAL);
            CalibrationFrame frame;
            frame.drive = 1;
            frame.time = f.seconds;
            frame.before = k > 0 ? frames[k - 1].time : f.seconds - INTERVAL;
            frame.interval = INTERVAL;
            std::vector<PointPair> pairs;
            for (int i = 0; i < f.points.rows; i++)
            {
                const Vec4d p = f.points.at<Vec4d>(i, 0);
                const PointPair pair = {Point2d(p[0], p[1]), Point2d(p[2], p[3])};
                pairs.push_back(pair);
            }
            addBearings(camera, pairs, INTERVAL, frame.bearings);
            std::vector<UprightSegment> others;
            Mat segments;
            f.segments.convertTo(segments, CV_64F);
            selectCandidates(segments, camera, params, frame.verticals, others);
            const SequenceFit fit = fitFrame(camera, frame.bearings, frame.verticals, usual, true);
            std::copy(fit.values, fit.values + FRAME_VALUES, frame.value.data());
            for (int i = 0; i < SCENE_VALUES; i++)
            {
                frame.expected[i] = usual.value[i];
                frame.sigma[i] = std::sqrt(usual.covariance(i, i));
            }
            frames.push_back(frame);
        }
        Mat times, rates;
        for (double t = -0.5; t < count * INTERVAL + 0.5; t += 0.004)
        {
            times.push_back(t);
            rates.push_back(Mat(street.rateAt(t).t()));
        }
        samples->add(times, rates);
        if (mode.hasGyro)
            for (CalibrationFrame& f : frames)
                f.rowTurns = RowTurns(*samples, GyroAlignment(), true, camera, camera.secondsPerUnitTime(), f.bearings,
                                      f.time, f.interval);
    }

    //! @param known multiplies what is known of the mount beforehand.
    MountFit fit(double known = 1) { return fitMount(camera, frames, known * sigmaBefore(), suspension); }

    //! The same with a lever that is known.
    MountFit fitHeading(double known)
    {
        MountVector sigma = known * sigmaBefore();
        sigma[MOUNT_LEVER] = 1e-6;
        return fitMount(camera, frames, sigma, suspension);
    }

    static MountVector sigmaBefore()
    {
        MountVector sigma;
        sigma << 0.05, 0.05, 0.09, LEVER_SIGMA, 0.3, 0.3;
        return sigma;
    }

    //! Median distance of points from where they should be, across the way of their depth.
    double residual() const
    {
        const ResidualSigmas usual = {1, 1, 1};
        const FrameProblem problem(camera, MountVector::Zero(), 1, usual);
        PointResiduals residuals;
        for (CalibrationFrame f : frames)
        {
            problem.weigh(f);
            problem.addPointResiduals(f, residuals);
        }
        std::vector<double> across;
        for (const UncertainResidual& r : residuals.across)
            across.push_back(r.value);
        std::nth_element(across.begin(), across.begin() + across.size() / 2, across.end());
        return across[across.size() / 2];
    }

    RollingShutterCamera camera;
    std::vector<CalibrationFrame> frames;
    Suspension suspension;
    std::shared_ptr<GyroSamples> samples;
};

typedef testing::TestWithParam<int> CalibrationEquations; // index of MODES

// Gradients are derivatives of the cost: those by the values of a frame next to the result, where they are those of
// small motions, and those by the mount anywhere.
TEST_P(CalibrationEquations, gradients)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    Recording recording(MODES[GetParam()], 2);
    const ResidualSigmas sigmas = {0.5, 0.7, 0.6};
    CalibrationFrame& frame = recording.frames[1];
    const auto problemAt = [&](const MountVector& mount) { return FrameProblem(recording.camera, mount, 2, sigmas); };
    MountVector mount;
    mount << 0, 0, 0.01, 0.7, 0.2, 0.15;
    problemAt(mount).weigh(frame);
    FrameVector value = frame.value;
    for (int i = 0; i < FRAME_VALUES; i++)
        value[i] += 0.02 * (i % 2 ? 1 : -1) * std::max(std::abs(value[i]), 0.05);
    const FrameEquations equations = problemAt(mount).evaluate(frame, value);
    const double h = 1e-5;
    for (int i = 0; i < FRAME_VALUES + SHARED_VALUES; i++)
    {
        MountVector more = mount, less = mount;
        FrameVector high = value, low = value;
        const bool isShared = i >= FRAME_VALUES;
        (isShared ? more[MOUNT_HEADING + i - FRAME_VALUES] : high[i]) += h;
        (isShared ? less[MOUNT_HEADING + i - FRAME_VALUES] : low[i]) -= h;
        const double slope =
            (problemAt(more).evaluate(frame, high).cost - problemAt(less).evaluate(frame, low).cost) / (4 * h);
        const double size = std::sqrt(equations.cost * equations.information(i, i));
        const bool isExact = isShared || i == SEQUENCE_ROLL || i == SEQUENCE_PITCH;
        EXPECT_NEAR(slope, equations.gradient[i], (isExact ? 1e-5 : 0.05) * size) << i;
    }
}

// Wherever the tilts begin, they end where they agree with the turns between frames.
TEST_P(CalibrationEquations, tilts_are_linked)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    Recording one(MODES[GetParam()], 24), other = one;
    for (size_t k = 0; k < other.frames.size(); k++)
    {
        other.frames[k].value[SEQUENCE_ROLL] += (k % 2 ? 0.5 : -0.5) * degree;
        other.frames[k].value[SEQUENCE_PITCH] -= (k % 2 ? 0.5 : -0.5) * degree;
    }
    const MountFit a = one.fit(), b = other.fit();
    EXPECT_LT((a.value - b.value).cwiseQuotient(a.sigma).norm(), 0.1);
    EXPECT_LT((a.sigma - b.sigma).cwiseQuotient(a.sigma).norm(), 0.05);
    for (const std::vector<CalibrationFrame>& frames : {one.frames, other.frames})
        for (size_t k = 1; k < frames.size(); k++)
        {
            const FrameVector &now = frames[k].value, &before = frames[k - 1].value;
            EXPECT_NEAR(now[FLOW_ROLL_BEFORE], now[SEQUENCE_ROLL] - before[SEQUENCE_ROLL], 0.02 * degree) << k;
            EXPECT_NEAR(now[FLOW_PITCH_BEFORE], now[SEQUENCE_PITCH] - before[SEQUENCE_PITCH], 0.02 * degree) << k;
        }
}

// Between two parts of a drive frames may be missing, or may show nothing: what the suspension lets expect is the same.
TEST_P(CalibrationEquations, frames_that_show_nothing)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const int count = 24, first = 8, last = 11; // of those that are missing
    Recording all(MODES[GetParam()], count);
    all.suspension.sigma = 0.05 * degree;
    Recording missing = all, empty = all;
    missing.frames.erase(missing.frames.begin() + first, missing.frames.begin() + last + 1);
    for (int k = first; k <= last; k++)
    {
        CalibrationFrame& frame = empty.frames[k];
        frame.before -= 0.1 * INTERVAL; // it doesn't follow, and nothing follows it
        frame.time -= 0.05 * INTERVAL;
        frame.bearings.clear();
        frame.verticals.clear();
        frame.value.setZero();
        std::copy(frame.expected, frame.expected + SCENE_VALUES, frame.value.data());
    }
    const MountFit a = missing.fit(), b = empty.fit();
    EXPECT_NEAR(1, b.turningSigma / a.turningSigma, 1e-3);
    double largest = 0;
    for (int k = 0; k < count; k++)
        if (k < first || k > last)
        {
            const FrameVector &one = missing.frames[k < first ? k : k - (last - first + 1)].value,
                              &other = empty.frames[k].value;
            for (const int i : {SEQUENCE_ROLL, SEQUENCE_PITCH})
                largest = std::max(largest, std::abs(one[i] - other[i]) / degree);
        }
    RecordProperty("ratio", format("%.6f", b.turningSigma / a.turningSigma));
    RecordProperty("largest", format("%.6f", largest));
    EXPECT_LT(largest, 1e-3);
}

// Frames that don't differ show nothing of how frames scatter: the information of their weights counts as that of four
// frames more. What is known beforehand is never lost by it.
TEST_P(CalibrationEquations, frames_that_are_all_the_same)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    Recording recording(MODES[GetParam()], 2);
    const CalibrationFrame frame = recording.frames[1];
    const auto copies = [&](int count) {
        recording.frames.assign(size_t(count), frame);
        for (int k = 0; k < count; k++)
            recording.frames[k].drive = k;
    };
    const int few = 8, many = 32;
    copies(few);
    const MountFit a = recording.fitHeading(100); // in one bend it can't be told from the lever
    copies(many);
    const MountFit b = recording.fitHeading(100);
    const double expected = double(few) * (few + 4) / (many * (many + 4));
    RecordProperty("ratio",
                   format("%.4f of %.4f", std::pow(b.sigma[MOUNT_HEADING] / a.sigma[MOUNT_HEADING], 2), expected));
    EXPECT_NEAR(1, std::pow(b.sigma[MOUNT_HEADING] / a.sigma[MOUNT_HEADING], 2) / expected, 0.15);
    for (const int count : {few, many})
        for (const double known : {1e-4, 1e-2, 1.})
        {
            copies(count);
            const MountFit fit = recording.fit(known);
            for (int i = MOUNT_HEADING; i < MOUNT_VALUES; i++)
                EXPECT_LT(fit.sigma[i], known * Recording::sigmaBefore()[i] * (1 + 1e-6)) << i << ", " << known;
        }
}

// The mean tilts follow the heading: where it is given they are no surer than it is.
TEST_P(CalibrationEquations, tilts_follow_a_given_heading)
{
    SCOPED_TRACE(MODES[GetParam()].name);
    const double known = 1e-3, step = 0.01;
    Recording recording(MODES[GetParam()], 2);
    recording.frames.assign(8, recording.frames[1]); // that don't scatter
    for (size_t k = 0; k < recording.frames.size(); k++)
        recording.frames[k].drive = int(k);
    const MountFit a = recording.fit(known);
    recording.camera.heading += step;
    const MountFit b = recording.fit(known);
    const double sigma = std::hypot(a.sigma[MOUNT_ROLL], a.sigma[MOUNT_PITCH]),
                 moved =
                     std::hypot(b.value[MOUNT_ROLL] - a.value[MOUNT_ROLL], b.value[MOUNT_PITCH] - a.value[MOUNT_PITCH]),
                 expected = moved / step * known * Recording::sigmaBefore()[MOUNT_HEADING];
    RecordProperty("ratio", format("%.3f", sigma / expected));
    EXPECT_GT(moved, 0.02 * step);
    EXPECT_GT(sigma, 0.9 * expected); // what else is given adds to it
}

// Of a camera that shakes points are nearer to where they should be if rows are turned back.
TEST_P(CalibrationEquations, rows_that_turn)
{
    if (!MODES[GetParam()].shakes)
        return;
    SCOPED_TRACE(MODES[GetParam()].name);
    Recording plain(MODES[GetParam()], 24), turned = plain;
    for (CalibrationFrame& f : plain.frames)
        f.rowTurns = RowTurns();
    plain.fit();
    std::list<GyroSamples> curves;
    if (MODES[GetParam()].hasGyro)
        turned = Recording(MODES[GetParam()], 24);
    else
        curves = turnRowsByNeighbours(turned.camera, 1, turned.frames);
    const MountFit fit = turned.fit();
    for (int i = MOUNT_HEADING; i < MOUNT_VALUES; i++)
        EXPECT_NEAR(0, fit.value[i], 3 * fit.sigma[i]) << i;
    RecordProperty("plain", format("%.4f", plain.residual()));
    RecordProperty("turned", format("%.4f", turned.residual()));
    EXPECT_LT(turned.residual(), 0.2 * plain.residual());
    // Both ends of verticals turn as points do.
    const double unit = turned.camera.secondsPerUnitTime();
    for (const CalibrationFrame& f : turned.frames)
        for (const UprightSegment& v : f.verticals)
        {
            const UprightSegment back = f.rowTurns.removedFrom(v, unit);
            const Vec3d *const ends[] = {&v.u, &v.v}, *const backEnds[] = {&back.u, &back.v};
            for (const int k : {0, 1})
            {
                TrackedBearing point = f.bearings[0];
                point.now = Point2d((*ends[k])[0], (*ends[k])[1]);
                point.timeNow = k == 0 ? v.timeU : v.timeV;
                const Point2d expected = f.rowTurns.removedFrom(point, unit).now;
                EXPECT_LT(cv::norm(Vec3d(expected.x, expected.y, 1) - *backEnds[k]), 1e-12);
            }
        }
}

// At which instants a gyro shows how rows turn depends on the line delay; how neighbours show it doesn't.
TEST_P(CalibrationEquations, rows_that_turn_by_another_line_delay)
{
    const Mode& mode = MODES[GetParam()];
    if (!mode.shakes)
        return;
    SCOPED_TRACE(mode.name);
    Recording recording(mode, 6);
    std::list<GyroSamples> curves;
    if (!mode.hasGyro)
        curves = turnRowsByNeighbours(recording.camera, 1, recording.frames);
    const CalibrationFrame& frame = recording.frames[3];
    const double unit = recording.camera.secondsPerUnitTime();
    ASSERT_TRUE(frame.rowTurns.known());
    double points = 0, ends = 0;
    for (const TrackedBearing& b : frame.bearings)
    {
        const TrackedBearing one = frame.rowTurns.removedFrom(b, unit),
                             other = frame.rowTurns.removedFrom(b, 1.2 * unit);
        points += cv::norm(one.now - other.now) + cv::norm(one.other - other.other);
    }
    for (const UprightSegment& v : frame.verticals)
    {
        const UprightSegment one = frame.rowTurns.removedFrom(v, unit),
                             other = frame.rowTurns.removedFrom(v, 1.2 * unit);
        ends += cv::norm(one.u - other.u) + cv::norm(one.v - other.v);
    }
    EXPECT_EQ(mode.hasGyro, points > 0);
    EXPECT_EQ(mode.hasGyro, ends > 0);
}

INSTANTIATE_TEST_CASE_P(RSAckermann, CalibrationEquations, testing::Range(0, int(sizeof(MODES) / sizeof(*MODES))));

}} // namespace opencv_test::
