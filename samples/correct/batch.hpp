// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_BATCH_HPP
#define RSACKERMANN_SAMPLES_BATCH_HPP

#include "frame_corrector.hpp"
#include "progress.hpp"
#include "report_file.hpp"
#include "targets.hpp"

namespace rsackermann_samples {

/** Corrects all inputs of a job.

Complete results stay when it is interrupted or killed; another run with --skip_existing goes on from there.
*/
class Batch
{
public:
    //! Throws InputError if the report can't be written or mustn't be replaced.
    explicit Batch(const Job& job);

    //! @return the exit code: 0 all is done, 1 some inputs failed, 128 and the signal's number if one has ended the
    //! work.
    int run();

private:
    // The work that is left for an input.
    struct Task
    {
        Targets targets;
        bool isReported; // already

        bool isDone() const { return targets.empty() && isReported; }
    };

    Task taskOf(const std::string& input) const;
    bool isLeftOut(size_t index, const Task& task) const;
    void correct(size_t index, const Task& task);
    FrameFacts factsOf(size_t index) const;
    NextFrame nextOf(size_t index) const;
    std::vector<FrameReport> correctFile(size_t index, const Targets& targets, std::string& error);
    void warnOfContradictions(const std::string& input, const std::vector<FrameReport>& frames);
    void fail(const std::string& input, const std::string& message);
    void report(const std::vector<std::string>& lines);

    const Job& job_;
    const std::vector<Input>& inputs_;
    std::unique_ptr<ReportFile> report_;
    FrameCorrector corrector_;
    Progress progress_;
    size_t lastTask_; // the last input that has something left to be done
    double done_;
    int failures_;
    bool hasWarned_; // of a contradiction
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_BATCH_HPP
