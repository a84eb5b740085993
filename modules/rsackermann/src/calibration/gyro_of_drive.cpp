// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../camera/axis_rotations.hpp"
#include "drive_turns.hpp"

namespace cv { namespace rsackermann {

// Since the frame before. Rows whose own turns are known don't blur it.
static TurnOfPoints turnOf(const CalibrationFrame& frame, const RollingShutterCamera& camera, double delayRatio)
{
    TurnOfPoints turn = frame.turn;
    if (frame.rowTurns.known())
    {
        // The turns of a fit are about the axes of the mount that it has found.
        RollingShutterCamera found = camera;
        found.uprightRotation =
            tiltRotation(frame.value[SEQUENCE_ROLL], frame.value[SEQUENCE_PITCH]) * camera.uprightRotation;
        turn = TurnOfPoints(found, frame.bearings, flowValues(frame.value).val, frame.time, -frame.interval);
    }
    const double middle = (turn.rows.from + turn.rows.to) / 2,
                 half = frame.rowTurns.known() ? 0 : (turn.rows.to - turn.rows.from) / 2;
    turn.rows = RowSpan(delayRatio * (middle - half), delayRatio * (middle + half));
    return turn;
}

GyroOfDrive alignGyro(const GyroSamples& samples, const RollingShutterCamera& camera, double delayRatio,
                      std::vector<CalibrationFrame>& frames)
{
    GyroOfDrive result;
    if (samples.empty())
        return result;
    GyroRates rates;
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
    result.alignment = rates.alignment();
    result.delaySigma = rates.alignmentSigma()[0];
    result.scaleSigma = rates.alignmentSigma()[7];
    return result;
}

}} // namespace cv::rsackermann
