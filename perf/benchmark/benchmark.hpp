// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_BENCHMARK_HPP
#define RSACKERMANN_PERF_BENCHMARK_HPP

#include <functional>
#include <string>
#include <vector>

namespace benchmark {

/** Measures pieces of work and computes figures from their times.

All work is done in turn, several rounds of it, so that what happens to the machine happens to all. A figure is the
median over the rounds of what it is in each of them.
*/
class Benchmark
{
public:
    typedef std::function<void()> Work;
    typedef std::function<double(const std::vector<double>&)> Formula;

    enum Threads { ONE_THREAD, ALL_THREADS };

    /** @param prepare makes the work; called only if a figure needs it.
        @return number of the work for figure(). */
    int work(const std::function<Work()>& prepare, Threads threads = ALL_THREADS);

    /** @param works whose times the figure needs.
        @param formula computes the figure from their times in seconds; the time itself if empty. */
    void figure(const std::string& name, const std::string& unit, const std::vector<int>& works,
                const Formula& formula);

    //! Prints the figures whose names contain the text.
    void run(const std::string& filter, int rounds, int threads) const;

private:
    struct Piece
    {
        std::function<Work()> prepare;
        Threads threads;
    };

    struct Figure
    {
        std::string name, unit;
        std::vector<int> works;
        Formula formula;
    };

    std::vector<Piece> pieces_;
    std::vector<Figure> figures_;
};

//! The time times a factor: 1e3 for milliseconds.
Benchmark::Formula scaled(double factor);
//! The first time over the sum of the others.
double overOthers(const std::vector<double>& times);

} // namespace benchmark

#endif // RSACKERMANN_PERF_BENCHMARK_HPP
