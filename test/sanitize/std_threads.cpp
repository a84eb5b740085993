// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "opencv2/core/parallel/parallel_backend.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

// cv::parallel_for_ with threads of the standard library, which ThreadSanitizer sees begin and end. It doesn't see how
// the TBB of Debian's OpenCV hands work over, and takes that for a race.

namespace {

thread_local int threadNumber = 0;

class StdThreads : public cv::parallel::ParallelForAPI
{
public:
    void parallel_for(int tasks, FN_parallel_for_body_cb_t body, void* data) override
    {
        // Shared out in advance: a common counter would order what has to be found unordered.
        const int count = std::min(count_, tasks);
        // A thread ends when all have done their work: its end takes locks of OpenCV, which would order its work before
        // that of later ones.
        std::atomic<int> working(count);
        std::vector<std::thread> threads;
        for (int number = 0; number < count; number++)
            threads.emplace_back([=, &working]() {
                threadNumber = number;
                for (int i = number; i < tasks; i += count)
                    body(i, i + 1, data);
                working.fetch_sub(1, std::memory_order_relaxed);
                while (working.load(std::memory_order_relaxed) > 0)
                    std::this_thread::yield();
            });
        for (std::thread& thread : threads)
            thread.join();
    }
    int getThreadNum() const override { return threadNumber; }
    int getNumThreads() const override { return count_; }
    int setNumThreads(int count) override
    {
        const int before = count_;
        count_ = count > 0 ? count : 4;
        return before;
    }
    const char* getName() const override { return "std::thread"; }

private:
    int count_ = 4;
};

// Before main(), since cv::parallel::setParallelForBackend() isn't safe in threads.
struct Installed
{
    Installed() { cv::parallel::setParallelForBackend(std::make_shared<StdThreads>()); }
} installed;

} // namespace
