// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "batch.hpp"
#include "files.hpp"
#include "gyro_clock.hpp"
#include "image_times.hpp"
#include "output/interrupt.hpp"
#ifdef RSACKERMANN_WITH_VIDEOIO
#include "video_task.hpp"
#endif

#include <algorithm>
#include <iostream>
#include <limits>

namespace rsackermann_samples {

namespace {

// What use() throws, as a text; an interruption goes on.
template <class Use>
std::string errorOf(const Use& use)
{
    try
    {
        use();
        return "";
    }
    catch (const Interrupted&)
    {
        throw;
    }
    catch (const cv::Exception& e)
    {
        return e.err;
    }
    catch (const std::exception& e)
    {
        return e.what();
    }
}

} // namespace

Batch::Batch(const Job& job)
    : job_(job), inputs_(job.inputs.inputs), threads_(cv::getNumThreads()),
      report_(job.report.empty() ? nullptr : new ReportFile(job)), corrector_(job), next_(0), largest_(0),
      warnings_(job, progress_), lastTask_(0), done_(0), failures_(0), hasClock_(false)
{
    if (job_.params.sequence)
        times_ = missingTimes(inputs_, job_.log);
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
            outcomes_.emplace_back(i, inputs_[i].error);
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
            outcomes_.emplace_back(i, e.what());
        }
    }
    finish(0);
    progress_.clear();
    if (!interruptSignal())
    {
        warnings_.end();
        return failures_ ? 1 : 0;
    }
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

FrameFacts Batch::factsOf(size_t index) const
{
    const Input& input = inputs_[index];
    FrameFacts facts = job_.log.of(input.name, input.number,
                                   times_.empty() ? std::numeric_limits<double>::quiet_NaN() : times_[index]);
    facts.intervals = input.intervals;
    return facts;
}

std::launch Batch::launchPolicy() const
{
    return threads_ > 1 ? std::launch::async : std::launch::deferred;
}

// How many images of a sequence are read ahead, and how many are written behind, of a size. Correction takes all
// processors for a part of the time only; a few images suffice to keep them busy.
size_t Batch::overlapOf(const cv::Size& size) const
{
    const int most = 3, pixels = 1 << 23;
    return threads_ > 1 ? size_t(std::min(std::max(pixels / std::max(size.area(), 1), 1), most)) : 0;
}

Batch::FutureImage Batch::imageOf(size_t index)
{
    const auto known = images_.find(index);
    if (known != images_.end())
        return known->second;
    const std::string& input = inputs_[index].name;
    return images_[index] = std::async(launchPolicy(), [&input]() { return readStored(input); }).share();
}

// An image that can't be read says so when it is its turn.
NextFrame Batch::nextOf(size_t index)
{
    if (!corrector_.wantsNext() || index + 1 >= inputs_.size() || isVideo(inputs_[index + 1].name))
        return NextFrame();
    NextFrame next;
    const std::string error =
        errorOf([&]() { next = NextFrame(imageOf(index + 1).get().pixels, corrector_.timeAfter(factsOf(index + 1))); });
    return error.empty() ? next : NextFrame();
}

// By the images from one to the next video.
double Batch::gyroDelayFrom(size_t index) const
{
    return gyroDelay(job_, [&](cv::Mat& image, FrameFacts& facts) {
        if (index == inputs_.size() || isVideo(inputs_[index].name))
            return false;
        image = cv::Mat();
        facts = factsOf(index);
        errorOf([&]() { image = readStored(inputs_[index].name).pixels; });
        index++;
        return true;
    });
}

void Batch::readAhead(size_t index, size_t count)
{
    for (; count > 0 && index < inputs_.size() && inputs_[index].isFile() && !isVideo(inputs_[index].name); index++)
        if (!job_.skipExisting || index < lastTask_)
        {
            imageOf(index);
            count--;
        }
}

void Batch::correct(size_t index, const Task& task)
{
    if (isVideo(inputs_[index].name))
        finish(0);
    Outcome outcome(index);
    outcome.isReported = task.isReported;
    // The error is reported and not thrown, as the frames of a video may be there though its end isn't.
    outcome.error = errorOf([&]() { correctFile(index, task.targets, outcome); });
    if (isVideo(inputs_[index].name)) // whether it has come to its end or not
        corrector_.reset();
    images_.erase(images_.begin(), images_.upper_bound(index));
    outcomes_.push_back(std::move(outcome));
}

void Batch::correctFile(size_t index, const Targets& targets, Outcome& outcome)
{
    const std::string& input = inputs_[index].name;
    if (isVideo(input))
        correctVideoFile(index, targets, outcome);
    else if (job_.params.sequence)
        correctOfSequence(index, targets, outcome);
    else
        correctAlone(index, targets, outcome);
}

void Batch::correctVideoFile(size_t index, const Targets& targets, Outcome& outcome)
{
    alone_.clear();
    cv::setNumThreads(threads_);
    corrector_.reset();
    hasClock_ = false;
    targets.check(job_);
#ifdef RSACKERMANN_WITH_VIDEOIO
    const std::string& input = inputs_[index].name;
    const double total = done_ + double(inputs_.size() - index);
    correctVideo(input, targets, job_, corrector_, outcome.frames,
                 [&](double share) { progress_.update(done_ + share, total, input); });
#endif
}

void Batch::correctOfSequence(size_t index, const Targets& targets, Outcome& outcome)
{
    const std::string& input = inputs_[index].name;
    if (needsGyroClock(job_) && !hasClock_)
        corrector_.setGyroDelay(gyroDelayFrom(index));
    corrector_.beginFrame(factsOf(index));
    hasClock_ = true;
    targets.check(job_);
    const StoredImage stored = imageOf(index).get();
    const size_t overlap = overlapOf(stored.pixels.size());
    readAhead(index + 1, overlap);
    CorrectedFrame frame = corrector_.correct(stored.pixels, nextOf(index), job_.depth.fileOf(inputs_[index]));
    frame.report.input = input;
    finish(overlap);
    outcome.written = std::async(launchPolicy(), [&input, stored, frame, targets]() {
        writeResults(input, stored, frame, targets).commit();
        return frame.report;
    });
}

void Batch::correctAlone(size_t index, const Targets& targets, Outcome& outcome)
{
    targets.check(job_);
    // Results needn't have reached the disk before other images are corrected; of as many again they may be left.
    if (!alone_.empty())
        finish(2 * (alone_.size() - 1));
    shareThreads();
    Alone& alone = alone_[next_++ % alone_.size()];
    if (alone.last.valid())
        alone.last.wait();
    const Input& input = inputs_[index];
    const FrameFacts facts = factsOf(index);
    FrameCorrector& corrector = *alone.corrector;
    alone.last = std::async(launchPolicy(), [this, &input, &corrector, facts, targets]() {
                     const StoredImage stored = readStored(input.name);
                     corrector.beginFrame(facts);
                     const CorrectedFrame frame =
                         corrector.correct(stored.pixels, NextFrame(), job_.depth.fileOf(input));
                     return Corrected{frame.report,
                                      std::make_shared<AtomicFiles>(writeResults(input.name, stored, frame, targets))};
                 }).share();
    const std::shared_future<Corrected> corrected = alone.last;
    // By the thread that waits for it, while the others go on with the next images.
    outcome.written = std::async(std::launch::deferred, [&input, corrected]() {
        corrected.get().results->commit();
        FrameReport report = corrected.get().report;
        report.input = input.name;
        return report;
    });
}

// Images are corrected at the same time, each with its share of the threads: one more than there are threads, so that
// processors needn't wait for files, as far as images like the largest one up to now fit into memory.
void Batch::shareThreads()
{
    const int pixels = 1 << 26;
    const int images = threads_ > 1 && largest_ > 0 ? std::min(std::max(pixels / largest_, 1), threads_ + 1) : 1;
    if (alone_.size() == size_t(images))
        return;
    finish(0);
    alone_.resize(size_t(images));
    for (Alone& alone : alone_)
        if (!alone.corrector)
            alone.corrector.reset(new FrameCorrector(job_));
    cv::setNumThreads(std::max(threads_ / images, 1));
}

// Waits for the results of inputs until so many are left.
void Batch::finish(size_t left)
{
    for (; outcomes_.size() > left; outcomes_.pop_front())
        finish(outcomes_.front());
}

void Batch::finish(Outcome& outcome)
{
    const std::string& input = inputs_[outcome.index].name;
    if (outcome.written.valid())
        outcome.error = errorOf([&]() { outcome.frames.push_back(outcome.written.get()); });
    std::vector<std::string> lines;
    for (const FrameReport& frame : outcome.frames)
    {
        lines.push_back(reportLine(frame));
        largest_ = std::max(largest_, frame.camera.imageSize.area());
        if (!frame.error.empty())
            complain(input + cv::format(": frame %d: ", frame.frame) + frame.error);
    }
    warnings_.add(input, outcome.frames);
    if (!outcome.isReported)
        report(lines);
    done_++;
    // Inputs that are left out take no time.
    if (outcome.error.empty())
        progress_.update(done_, done_ + double(inputs_.size() - outcome.index - 1), input);
    else
        fail(input, outcome.error);
}

void Batch::fail(const std::string& input, const std::string& message)
{
    complain(input + ": " + message);
    report({failureLine(input, message)});
}

void Batch::complain(const std::string& message)
{
    failures_++;
    progress_.clear();
    std::cerr << "rsackermann_correct: " << message << std::endl;
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
        complain(std::string("the report: ") + e.what());
    }
}

} // namespace rsackermann_samples
