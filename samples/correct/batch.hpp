// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_BATCH_HPP
#define RSACKERMANN_SAMPLES_BATCH_HPP

#include "image_task.hpp"
#include "progress.hpp"
#include "report_file.hpp"
#include "warnings.hpp"
#include <deque>
#include <future>
#include <map>

namespace rsackermann_samples {

/** Corrects all inputs of a job.

With more than one thread images that don't depend on each other are corrected at the same time. Of those of a sequence
the next ones are read and the results of the last ones written while one is corrected. What is said of them comes in
the order of the inputs.

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

    // An input that is still being corrected, or whose results are still being written.
    struct Outcome
    {
        size_t index;
        bool isReported; // already
        std::vector<FrameReport> frames;
        std::string error;
        std::future<FrameReport> written; // of an image

        explicit Outcome(size_t index_, const std::string& error_ = "")
            : index(index_), isReported(false), error(error_)
        {
        }
    };

    // An image whose results have still to reach the disk.
    struct Corrected
    {
        FrameReport report;
        std::shared_ptr<AtomicFiles> results;
    };

    // Corrects one image after another, none of which depends on others.
    struct Alone
    {
        std::unique_ptr<FrameCorrector> corrector;
        std::shared_future<Corrected> last;
    };

    typedef std::shared_future<StoredImage> FutureImage;

    Task taskOf(const std::string& input) const;
    bool isLeftOut(size_t index, const Task& task) const;
    FrameFacts factsOf(size_t index) const;
    std::launch launchPolicy() const;
    size_t overlapOf(const cv::Size& size) const;
    FutureImage imageOf(size_t index);
    NextFrame nextOf(size_t index);
    double gyroDelayFrom(size_t index) const;
    void readAhead(size_t index, size_t count);
    void correct(size_t index, const Task& task);
    void correctFile(size_t index, const Targets& targets, Outcome& outcome);
    void correctVideoFile(size_t index, const Targets& targets, Outcome& outcome);
    void correctOfSequence(size_t index, const Targets& targets, Outcome& outcome);
    void correctAlone(size_t index, const Targets& targets, Outcome& outcome);
    void shareThreads();
    void finish(size_t left);
    void finish(Outcome& outcome);
    void fail(const std::string& input, const std::string& message);
    void complain(const std::string& message);
    void report(const std::vector<std::string>& lines);

    const Job& job_;
    const std::vector<Input>& inputs_;
    std::vector<double> times_; // of missingTimes()
    const int threads_;
    std::unique_ptr<ReportFile> report_;
    FrameCorrector corrector_; // of sequences and videos
    std::vector<Alone> alone_; // one for each image that is corrected at the same time
    size_t next_;              // of them
    int largest_;              // pixels, of the images up to now; 0: there was none
    Progress progress_;
    Warnings warnings_;
    std::map<size_t, FutureImage> images_; // by their places among the inputs
    std::deque<Outcome> outcomes_;
    size_t lastTask_; // the last input that has something left to be done
    double done_;
    int failures_;
    bool hasClock_; // the gyro, of the sequence that the last input belongs to
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_BATCH_HPP
