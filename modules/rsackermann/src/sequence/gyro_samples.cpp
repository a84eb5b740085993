// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../checks.hpp"
#include "gyro_samples.hpp"

namespace cv { namespace rsackermann {

static const double GYRO_GAP = 0.1; // seconds without a sample: slower gyros don't see what shakes

static void check(const Mat& times, const Mat& rates)
{
    REJECT_IF(!times.empty() && (times.type() != CV_64F || std::min(times.rows, times.cols) != 1),
              "times is %d x %d of type %s; N x 1 of type CV_64FC1 is expected", times.rows, times.cols,
              typeToString(times.type()).c_str());
    REJECT_IF(!(times.empty() && rates.empty()) &&
                  (rates.type() != CV_64F || rates.cols != 3 || size_t(rates.rows) != times.total()),
              "rates is %d x %d of type %s; %d x 3 of type CV_64FC1 is expected", rates.rows, rates.cols,
              typeToString(rates.type()).c_str(), int(times.total()));
}

void GyroSamples::add(const Mat& times_, const Mat& rates, double origin)
{
    check(times_, rates);
    const Mat times = times_.isContinuous() ? times_ : times_.clone();
    const double* const time = times.ptr<double>();
    for (int i = 0; i < rates.rows; i++) // before any of them is added
    {
        if (!(std::abs(time[i]) <= 1e12))
            checkRange(time[i], -1e12, 1e12, format("times[%d]", i).c_str());
        const bool isFirst = i == 0 && samples.empty();
        const double last = i > 0 ? time[i - 1] : isFirst ? 0 : lastTime() + origin;
        REJECT_IF(!isFirst && !(time[i] > last), "times[%d] is %.9g; more than %.9g, the one before, is expected", i,
                  time[i], last);
        for (int k = 0; k < 3; k++)
            if (!(std::abs(rates.at<double>(i, k)) <= fastest()))
                checkRange(rates.at<double>(i, k), -fastest(), fastest(), format("rates(%d, %d)", i, k).c_str());
    }
    for (int i = 0; i < rates.rows; i++)
    {
        samples.push_back({time[i] - origin, Vec3d(rates.ptr<double>(i)), Vec3d(), Vec3d(), 0});
        // The one before has a neighbour now.
        for (size_t k = std::max<size_t>(samples.size(), 3) - 2; k < samples.size(); k++)
            integrate(k);
        noise.add(samples);
    }
}

void GyroSamples::Noise::add(const std::vector<Sample>& all)
{
    const int coefficients[] = {1, -8, 28, -56, 70, -56, 28, -8, 1}, order = 8;
    const double sumOfSquares = 12870;
    if (all.size() <= size_t(order))
        return;
    const Sample *const last = &all.back(), *const first = last - order;
    if (last->gaps != first->gaps)
        return;
    Vec3d difference;
    for (int i = 0; i <= order; i++)
        difference += coefficients[i] * first[i].rate;
    squares += difference.dot(difference) / (3 * sumOfSquares);
    seconds += (last->time - first->time) / order;
    count++;
}

double GyroSamples::angleNoise() const
{
    return noise.count > 0 ? noise.squares / noise.count * noise.seconds / noise.count : 0;
}

void GyroSamples::clear()
{
    samples.clear();
    noise = Noise();
}

void GyroSamples::forgetBefore(double time)
{
    const auto last = samples.end() - std::min<size_t>(samples.size(), 2); // that the next ones go on from
    const auto kept =
        std::lower_bound(samples.begin(), last, time, [](const Sample& sample, double t) { return sample.time < t; });
    if (kept - samples.begin() > samples.end() - kept)
        samples.erase(samples.begin(), kept);
}

// From the sample before a later one to that: a cubic through the rates, whose slopes are those of the chords on both
// sides. Straight pieces would lose what shakes nearly as fast as samples follow.
void GyroSamples::integrate(size_t k)
{
    Sample &a = samples[k - 1], &b = samples[k];
    const double interval = b.time - a.time;
    const Vec3d chord = (b.rate - a.rate) * (1 / interval);
    const bool isGap = interval > GYRO_GAP,
               hasNext = k + 1 < samples.size() && samples[k + 1].time - b.time <= GYRO_GAP && !isGap;
    b.slope = hasNext ? (samples[k + 1].rate - a.rate) * (1 / (samples[k + 1].time - a.time)) : isGap ? Vec3d() : chord;
    if (k == 1 || isGap || samples[k - 1].gaps > samples[k - 2].gaps)
        a.slope = isGap ? a.slope : chord;
    b.angle = a.angle + (a.rate + b.rate) * (interval / 2) + (a.slope - b.slope) * (interval * interval / 12);
    b.gaps = a.gaps + isGap;
}

// The sample before a time, or the first or the last but one.
size_t GyroSamples::before(double time) const
{
    const auto after = std::upper_bound(samples.begin(), samples.end(), time,
                                        [](double t, const Sample& sample) { return t < sample.time; });
    const std::ptrdiff_t last = std::max<std::ptrdiff_t>(std::ptrdiff_t(samples.size()) - 2, 0);
    return size_t(std::min(std::max<std::ptrdiff_t>(after - samples.begin() - 1, 0), last));
}

bool GyroSamples::covers(double begin, double end) const
{
    if (samples.size() < 2 || begin < samples.front().time || end > samples.back().time)
        return false;
    const auto last = std::lower_bound(samples.begin(), samples.end(), end,
                                       [](const Sample& sample, double t) { return sample.time < t; });
    return samples[before(begin)].gaps == last->gaps;
}

Vec3d GyroSamples::angleAt(double time) const
{
    const size_t i = before(time);
    const Sample &a = samples[i], &b = samples[i + 1];
    const double interval = b.time - a.time, t = (time - a.time) / interval;
    // Hermite's cubic, integrated.
    const Vec3d ofRates = a.rate * (t - t * t * t + t * t * t * t / 2) + b.rate * (t * t * t - t * t * t * t / 2),
                ofSlopes = a.slope * (t * t / 2 - 2 * t * t * t / 3 + t * t * t * t / 4) +
                           b.slope * (t * t * t * t / 4 - t * t * t / 3);
    return a.angle + ofRates * interval + ofSlopes * (interval * interval);
}

bool GyroSamples::meanRate(double begin, double end, double from, double to, Vec3d& rate) const
{
    if (!covers(begin + from, end + to))
        return false;
    const int instants = 4;
    Vec3d sum;
    for (int i = 0; i < instants; i++)
    {
        const double later = from + (to - from) * (i + 0.5) / instants;
        sum += angleAt(end + later) - angleAt(begin + later);
    }
    rate = sum * (1 / (instants * (end - begin)));
    return true;
}

bool GyroSamples::turn(double begin, double end, Vec3d& angle) const
{
    if (!covers(begin, end))
        return false;
    angle = angleAt(end) - angleAt(begin);
    return true;
}

bool GyroSamples::rowRate(double instant, double from, double to, Vec3d& rate) const
{
    if (!covers(instant + std::min(from, 0.), instant + std::max(to, 0.)))
        return false;
    const int instants = 8;
    const Vec3d middle = angleAt(instant);
    Vec3d sum;
    double squares = 0;
    for (int i = 0; i < instants; i++)
    {
        const double later = from + (to - from) * (i + 0.5) / instants;
        sum += (angleAt(instant + later) - middle) * later;
        squares += later * later;
    }
    rate = sum * (1 / squares);
    return squares > 0;
}

}} // namespace cv::rsackermann
