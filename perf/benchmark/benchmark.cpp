// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "benchmark.hpp"

#include "opencv2/core.hpp"
#include "opencv2/core/utility.hpp"
#include <algorithm>
#include <cstdio>

namespace benchmark {

namespace {

// Seconds for which a piece of work is repeated in a round, and how often at most.
const double ROUND_SECONDS = 0.03;
const int MAX_CALLS = 100;

double secondsOf(const Benchmark::Work& work)
{
    const int64 start = cv::getTickCount();
    work();
    return double(cv::getTickCount() - start) / cv::getTickFrequency();
}

double median(std::vector<double> values)
{
    const size_t half = values.size() / 2;
    std::nth_element(values.begin(), values.begin() + half, values.end());
    return values[half];
}

// The first call warms up caches and threads.
double medianSeconds(const Benchmark::Work& work)
{
    work();
    std::vector<double> seconds;
    double sum = 0;
    while (sum < ROUND_SECONDS && seconds.size() < MAX_CALLS)
    {
        seconds.push_back(secondsOf(work));
        sum += seconds.back();
    }
    return median(seconds);
}

} // namespace

int Benchmark::work(const std::function<Work()>& prepare, Threads threads)
{
    const Piece piece = {prepare, threads};
    pieces_.push_back(piece);
    return int(pieces_.size()) - 1;
}

void Benchmark::figure(const std::string& name, const std::string& unit, const std::vector<int>& works,
                       const Formula& formula)
{
    const Figure figure = {name, unit, works, formula};
    figures_.push_back(figure);
}

void Benchmark::run(const std::string& filter, int rounds, int threads) const
{
    std::vector<const Figure*> wanted;
    std::vector<Work> works(pieces_.size());
    for (const Figure& figure : figures_)
    {
        if (figure.name.find(filter) == std::string::npos)
            continue;
        wanted.push_back(&figure);
        for (int i : figure.works)
            if (!works[i])
                works[i] = pieces_[i].prepare();
    }

    std::vector<std::vector<double>> values(wanted.size());
    for (int round = 0; round < rounds; round++)
    {
        std::vector<double> seconds(works.size());
        for (const Threads number : {ONE_THREAD, ALL_THREADS})
        {
            cv::setNumThreads(number == ONE_THREAD ? 1 : threads);
            for (size_t i = 0; i < works.size(); i++)
                if (works[i] && pieces_[i].threads == number)
                    seconds[i] = medianSeconds(works[i]);
        }
        for (size_t k = 0; k < wanted.size(); k++)
        {
            std::vector<double> times;
            for (int i : wanted[k]->works)
                times.push_back(seconds[i]);
            values[k].push_back(wanted[k]->formula(times));
        }
    }
    for (size_t k = 0; k < wanted.size(); k++)
        std::printf("%s\t%.4g\t%s\n", wanted[k]->name.c_str(), median(values[k]), wanted[k]->unit.c_str());
}

Benchmark::Formula scaled(double factor)
{
    return [factor](const std::vector<double>& times) { return factor * times[0]; };
}

double overOthers(const std::vector<double>& times)
{
    double sum = 0;
    for (size_t i = 1; i < times.size(); i++)
        sum += times[i];
    return times[0] / sum;
}

} // namespace benchmark
