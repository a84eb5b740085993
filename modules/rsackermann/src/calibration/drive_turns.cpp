// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "drive_turns.hpp"

namespace cv { namespace rsackermann {

// Since the frame before, as the unknowns have it.
static TurnOfPoints turnOf(const CalibrationFrame& frame, const RollingShutterCamera& camera)
{
    const Vec<double, FLOW_VALUES> values = flowValues(frame.value);
    NeighbourTurns turns;
    turns.pitch.angle = values[FLOW_PITCH_BEFORE];
    turns.roll.angle = values[FLOW_ROLL_BEFORE];
    return TurnOfPoints(camera, frame.bearings, values.val, turns, frame.time, -frame.interval);
}

// Rows whose own turns are known don't blur it.
static TurnOfPoints turnOf(const CalibrationFrame& frame, const RollingShutterCamera& camera, double delayRatio)
{
    TurnOfPoints turn = turnOf(frame, camera);
    const double middle = (turn.rows.from + turn.rows.to) / 2,
                 half = frame.rowTurns.known() ? 0 : (turn.rows.to - turn.rows.from) / 2;
    turn.rows = RowSpan(delayRatio * (middle - half), delayRatio * (middle + half));
    return turn;
}

// Where rows don't turn but for the gyro's noise, a shorter line delay would leave less of it: what is known of how
// they turn is the share of the turns that isn't noise (regression calibration [carroll2006]).
static void takeNoiseOff(const GyroSamples& samples, const RollingShutterCamera& camera, double delayRatio,
                         std::vector<CalibrationFrame>& frames)
{
    const RowSpan rows(camera);
    const double after = delayRatio * (rows.to - rows.from) / 2, noise = samples.angleNoise() * after;
    Vec3d squares;
    int count = 0;
    for (const CalibrationFrame& frame : frames)
        for (int sign = -1; sign <= 1 && frame.rowTurns.showDelay(); sign += 2)
        {
            const Vec3d turn = frame.rowTurns.unsteadyTurn(sign * after);
            squares += turn.mul(turn);
            count++;
        }
    Vec3d share;
    for (int axis = 0; axis < 3; axis++)
        share[axis] = squares[axis] > 0 ? std::max(1 - noise * count / squares[axis], 0.) : 0;
    for (CalibrationFrame& frame : frames)
        if (frame.rowTurns.showDelay())
            frame.rowTurns.take(share);
}

GyroOfDrive alignGyro(const GyroSamples& samples, const RollingShutterCamera& camera, double delayRatio,
                      std::vector<CalibrationFrame>& frames)
{
    GyroOfDrive result;
    if (samples.empty())
        return result;
    GyroSigmas sigmas;
    sigmas.scale = std::hypot(sigmas.scale, camera.focalSigma / camera.cameraMatrix(0, 0));
    GyroRates rates;
    rates.setSigmas(sigmas);
    rates.samples = samples;
    size_t aligned = 0;
    const auto alignUntil = [&](size_t end) {
        for (; aligned < end; aligned++)
        {
            CalibrationFrame& frame = frames[aligned];
            if (rates.contradicts())
                continue;
            const RowTurns turns(samples, rates.alignment(), true, camera, delayRatio * camera.secondsPerUnitTime(),
                                 frame.bearings, frame.time, frame.interval);
            if (!turns.known())
                continue;
            frame.rowTurns = turns;
            result.frames++;
        }
    };
    for (size_t k = 0; k < frames.size(); k++)
    {
        if (k > 0 && frames[k].drive != frames[k - 1].drive)
        {
            alignUntil(k);
            rates.reset();
        }
        rates.add(turnOf(frames[k], camera, delayRatio));
        // Half of what it remembers is later than a frame.
        size_t end = aligned;
        while (end < k && frames[end].time < frames[k].time - RATE_MEMORY / 2)
            end++;
        alignUntil(end);
    }
    alignUntil(frames.size());
    if (result.frames == 0)
        return result;
    takeNoiseOff(samples, camera, delayRatio, frames);
    result.alignment = rates.alignment();
    result.delaySigma = rates.alignmentSigma()[0];
    result.scaleSigma = rates.alignmentSigma()[7];
    return result;
}

namespace {

// The natural cubic spline through the angles of instants.
class AngleCurve
{
public:
    AngleCurve(const std::vector<double>& times_, const std::vector<Vec3d>& angles_)
        : times(times_), angles(angles_), bend(angles_.size())
    {
        // Elimination in the tridiagonal system of the second derivatives, which are 0 at both ends.
        const size_t n = times.size();
        std::vector<double> above(n, 0.);
        for (size_t i = 1; i + 1 < n; i++)
        {
            const double before = step(i - 1), after = step(i), pivot = 2 * (before + after) - before * above[i - 1];
            above[i] = after / pivot;
            bend[i] = (6 * (chord(i) - chord(i - 1)) - before * bend[i - 1]) * (1 / pivot);
        }
        for (size_t i = n - 1; i-- > 1;)
            bend[i] -= above[i] * bend[i + 1];
    }

    //! @param share of the way from the instant i to the next one.
    Vec3d rate(size_t i, double share) const
    {
        const double h = step(i), rest = 1 - share;
        return chord(i) + (bend[i] * (1 - 3 * rest * rest) + bend[i + 1] * (3 * share * share - 1)) * (h / 6);
    }

private:
    double step(size_t i) const { return times[i + 1] - times[i]; }
    Vec3d chord(size_t i) const { return (angles[i + 1] - angles[i]) * (1 / step(i)); }

    const std::vector<double>& times;
    const std::vector<Vec3d>& angles;
    std::vector<Vec3d> bend; // second derivatives
};

GyroSamples sampled(const std::vector<double>& times, const std::vector<Vec3d>& angles)
{
    const int parts = 4; // of an interval: GyroSamples is as smooth
    const AngleCurve curve(times, angles);
    Mat instants, rates;
    for (size_t i = 0; i + 1 < times.size(); i++)
        for (int k = 0; k < parts + (i + 2 == times.size()); k++)
        {
            const double share = double(k) / parts;
            instants.push_back(times[i] + share * (times[i + 1] - times[i]));
            rates.push_back(Mat(curve.rate(i, share).t()));
        }
    if (!(norm(rates, NORM_INF) <= GyroSamples::fastest()))
        return GyroSamples();
    GyroSamples samples;
    samples.add(instants, rates);
    return samples;
}

} // namespace

std::list<GyroSamples> turnRowsByNeighbours(const RollingShutterCamera& camera, double delayRatio,
                                            std::vector<CalibrationFrame>& frames)
{
    const double unit = delayRatio * camera.secondsPerUnitTime();
    std::list<GyroSamples> curves;
    for (size_t begin = 0, end; begin < frames.size(); begin = end)
    {
        // On this clock the middle row of each frame has the time of the frame since the first one.
        std::vector<double> times(1, -frames[begin].interval);
        std::vector<Vec3d> angles(1);
        for (end = begin; end < frames.size() && (end == begin || frames[end].follows(frames[end - 1])); end++)
        {
            const CalibrationFrame& frame = frames[end];
            times.push_back(frame.time - frames[begin].time);
            angles.push_back(angles.back() + turnOf(frame, camera).rate * frame.interval);
        }
        curves.push_back(sampled(times, angles));
        for (size_t k = begin; k < end; k++)
        {
            GyroAlignment clock;
            clock.delay = -frames[begin].time;
            for (const TrackedBearing& point : frames[k].bearings)
                clock.delay -= unit * point.timeNow / double(frames[k].bearings.size());
            frames[k].rowTurns = RowTurns(curves.back(), clock, false, camera, unit, frames[k].bearings, frames[k].time,
                                          frames[k].interval);
        }
    }
    return curves;
}

}} // namespace cv::rsackermann
