// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "batch.hpp"
#include "files.hpp"
#include "image_task.hpp"
#include "output/interrupt.hpp"
#ifdef RSACKERMANN_WITH_VIDEOIO
#include "video_task.hpp"
#endif

#include <iostream>
#include <limits>

namespace rsackermann_samples {

Batch::Batch(const Job& job)
    : job_(job), inputs_(job.inputs.inputs), report_(job.report.empty() ? nullptr : new ReportFile(job)),
      corrector_(job), lastTask_(0), done_(0), failures_(0), hasWarned_(false)
{
    for (size_t i = 0; i < inputs_.size(); i++)
        if (inputs_[i].isFile() && !isVideo(inputs_[i].name) && !taskOf(inputs_[i].name).isDone())
            lastTask_ = i;
}

int Batch::run()
{
    for (size_t i = 0; i < inputs_.size() && !interruptSignal(); i++)
    {
        if (!inputs_[i].isFile())
        {
            corrector_.beginFrame(factsOf(i));
            fail(inputs_[i].name, inputs_[i].error);
            continue;
        }
        try
        {
            const Task task = taskOf(inputs_[i].name);
            if (isLeftOut(i, task))
                continue;
            correct(i, task);
        }
        catch (const Interrupted&)
        {
            break;
        }
        catch (const InputError& e)
        {
            fail(inputs_[i].name, e.what());
        }
        done_++;
    }
    progress_.clear();
    if (!interruptSignal())
        return failures_ ? 1 : 0;
    std::cerr << "rsackermann_correct: interrupted; complete results stay, and --skip_existing goes on from there"
              << std::endl;
    return 128 + interruptSignal();
}

Batch::Task Batch::taskOf(const std::string& input) const
{
    Task task = {Targets(job_, input), !report_ || report_->has(input)};
    if (job_.skipExisting)
        task.targets.leaveOutExisting();
    return task;
}

// If a motion is carried from image to image those before the last one that is left to be done count.
bool Batch::isLeftOut(size_t index, const Task& task) const
{
    const bool isCarried = job_.params.sequence && !isVideo(inputs_[index].name);
    return job_.skipExisting && task.isDone() && !(isCarried && index < lastTask_);
}

void Batch::correct(size_t index, const Task& task)
{
    const std::string& input = inputs_[index].name;
    std::string error;
    std::vector<std::string> lines;
    const std::vector<FrameReport> frames = correctFile(index, task.targets, error);
    for (const FrameReport& frame : frames)
        lines.push_back(reportLine(frame));
    warnOfContradictions(input, frames);
    if (task.isReported)
        lines.clear();
    report(lines);
    if (!error.empty())
        fail(input, error);
}

FrameFacts Batch::factsOf(size_t index) const
{
    return job_.log.of(inputs_[index].name, inputs_[index].number, std::numeric_limits<double>::quiet_NaN());
}

// An image that can't be read says so when it is its turn.
NextFrame Batch::nextOf(size_t index) const
{
    if (!corrector_.wantsNext() || index + 1 >= inputs_.size() || isVideo(inputs_[index + 1].name))
        return NextFrame();
    try
    {
        return NextFrame(readImage(inputs_[index + 1].name), factsOf(index + 1).time);
    }
    catch (const InputError&)
    {
        return NextFrame();
    }
}

// The error is reported and not thrown, as the frames of a video may be there though its end isn't.
std::vector<FrameReport> Batch::correctFile(size_t index, const Targets& targets, std::string& error)
{
    const std::string& input = inputs_[index].name;
    // Inputs that are left out take no time.
    const double total = done_ + double(inputs_.size() - index);
    std::vector<FrameReport> frames;
    if (isVideo(input))
        corrector_.reset();
    else
        corrector_.beginFrame(factsOf(index));
    try
    {
        targets.check(job_);
#ifdef RSACKERMANN_WITH_VIDEOIO
        if (isVideo(input))
        {
            correctVideo(input, targets, job_, corrector_, frames,
                         [&](double share) { progress_.update(done_ + share, total, input); });
        }
        else
#endif
        {
            frames.push_back(
                correctImage(input, targets, nextOf(index), job_.depth.fileOf(inputs_[index]), corrector_));
            progress_.update(done_ + 1, total, input);
        }
    }
    catch (const Interrupted&)
    {
        throw;
    }
    catch (const cv::Exception& e)
    {
        error = e.err;
    }
    catch (const std::exception& e)
    {
        error = e.what();
    }
    if (isVideo(input)) // whether it has come to its end or not
        corrector_.reset();
    return frames;
}

// Once for each input or sequence: a sensor that is wrong is so in many frames.
void Batch::warnOfContradictions(const std::string& input, const std::vector<FrameReport>& frames)
{
    const FrameReport* first = nullptr;
    size_t count = 0;
    for (const FrameReport& frame : frames)
        if (frame.motion.contradictsPrior && count++ == 0)
            first = &frame;
    if (!first || (job_.params.sequence && !isVideo(input) && hasWarned_))
        return;
    hasWarned_ = true;
    progress_.clear();
    std::cerr << "rsackermann_correct: " << input << ": "
              << (first->frame >= 0 ? cv::format("frame %d of %zu such: ", first->frame, count) : "")
              << contradiction(*first) << std::endl;
}

void Batch::fail(const std::string& input, const std::string& message)
{
    failures_++;
    progress_.clear();
    std::cerr << "rsackermann_correct: " << input << ": " << message << std::endl;
    report({failureLine(input, message)});
}

void Batch::report(const std::vector<std::string>& lines)
{
    if (!report_ || lines.empty())
        return;
    try
    {
        report_->add(lines);
    }
    catch (const InputError& e)
    {
        failures_++;
        progress_.clear();
        std::cerr << "rsackermann_correct: the report: " << e.what() << std::endl;
    }
}

} // namespace rsackermann_samples
