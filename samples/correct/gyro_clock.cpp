// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "gyro_clock.hpp"
#include "output/interrupt.hpp"

namespace rsackermann_samples {

bool needsGyroClock(const Job& job)
{
    return job.params.sequence && !job.gyro.times.empty() && !job.gyro.isClockKnown;
}

double gyroDelay(const Job& job, const FrameSource& read)
{
    const int frames = 20; // more than a delay takes to be found
    Job trial = job;
    trial.output = trial.overlay = trial.maps = "";
    trial.smooth = false;
    FrameCorrector corrector(trial);
    cv::Mat image;
    FrameFacts facts;
    for (int i = 0; i < frames && !interruptSignal() && read(image, facts); i++)
    {
        corrector.beginFrame(facts);
        try
        {
            if (!image.empty())
                corrector.correct(image);
        }
        catch (const std::exception&)
        {
            // It is said when it's the frame's turn.
        }
    }
    return corrector.gyroDelay();
}

} // namespace rsackermann_samples
