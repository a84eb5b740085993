// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "inputs.hpp"
#include "files.hpp"
#include "options.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgcodecs.hpp"
#include <algorithm>
#include <climits>
#include <cmath>
#include <map>
#include <set>

namespace rsackermann_samples {

namespace {

namespace fs = cv::utils::fs;

bool isOneOf(const std::string& word, const std::vector<std::string>& words)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

// The run of digits that begins at a place, without zeros before the number, and the place behind it.
std::string numberAt(const std::string& text, size_t& place)
{
    const size_t begin = place;
    while (place < text.size() && isDigit(text[place]))
        place++;
    const std::string run = text.substr(begin, place - begin);
    return run.substr(std::min(run.find_first_not_of('0'), run.size()));
}

// The order of frames: runs of digits compare as numbers, so that frame2 is before frame10, everything else as text.
bool isBefore(const std::string& a, const std::string& b)
{
    size_t i = 0, k = 0;
    while (i < a.size() && k < b.size())
        if (isDigit(a[i]) && isDigit(b[k]))
        {
            const std::string x = numberAt(a, i), y = numberAt(b, k);
            if (x != y)
                return x.size() != y.size() ? x.size() < y.size() : x < y;
        }
        else if (a[i] != b[k])
            return uchar(a[i]) < uchar(b[k]);
        else
            i++, k++;
    const size_t restOfA = a.size() - i, restOfB = b.size() - k;
    return restOfA != restOfB ? restOfA < restOfB : a < b; // f1 and f01 are the same number
}

std::vector<std::string> filesOf(const std::string& folder)
{
    std::vector<cv::String> paths;
    try
    {
        fs::glob(folder, "*", paths, false, false);
    }
    catch (const cv::Exception&)
    {
        throw InputError("the folder can't be read");
    }
    // Hidden files aren't meant: temporary ones, and those of file managers.
    paths.erase(
        std::remove_if(paths.begin(), paths.end(), [](const std::string& path) { return fileName(path)[0] == '.'; }),
        paths.end());
    std::sort(paths.begin(), paths.end(), isBefore);
    return std::vector<std::string>(paths.begin(), paths.end());
}

// Tells, by their extensions, of files that may be missed.
std::string toldOf(const std::map<std::string, int>& skipped, const std::string& folder)
{
    std::string list;
    int count = 0;
    for (const std::pair<const std::string, int>& kind : skipped)
    {
        list += (list.empty() ? "" : ", ") + std::to_string(kind.second) + " " +
                (kind.first.empty() ? "without an extension" : kind.first);
        count += kind.second;
    }
    return cv::format("%s stands for its images; %d other file%s left out: %s", folder.c_str(), count,
                      count == 1 ? " is" : "s are", list.c_str());
}

std::vector<std::string> imagesOf(const std::string& folder, std::vector<std::string>& warnings)
{
    static const std::vector<std::string> known = {".png",  ".jpg",  ".jpeg", ".jpe", ".bmp", ".dib", ".tif",
                                                   ".tiff", ".webp", ".jp2",  ".pgm", ".ppm", ".pbm", ".pnm",
                                                   ".pxm",  ".sr",   ".ras",  ".exr", ".hdr", ".pic"};
    std::vector<std::string> images;
    std::map<std::string, int> skipped;
    for (const std::string& path : filesOf(folder))
        if (isOneOf(extension(path), known))
            images.push_back(path);
        else if (isVideo(path) || (!isPipe(path) && cv::haveImageReader(path)))
            skipped[extension(path)]++;
    if (!skipped.empty())
        warnings.push_back(toldOf(skipped, folder));
    return images;
}

// A pattern with one %d or %0Nd.
struct NumberPattern
{
    std::string before, after;
    size_t digits; // at least

    // False if the text is no such pattern.
    bool parse(const std::string& text)
    {
        const size_t percent = text.find('%'), d = text.find('d', percent);
        if (percent == std::string::npos || d == std::string::npos)
            return false;
        const std::string width = text.substr(percent + 1, d - percent - 1);
        if (width.find_first_not_of("0123456789") != std::string::npos || width.size() > 3)
            return false;
        before = text.substr(0, percent);
        after = text.substr(d + 1);
        digits = width.empty() ? 1 : size_t(std::stoi(width));
        return true;
    }

    // The number in a name; false if the name doesn't match.
    bool match(const std::string& name, long& number) const
    {
        if (name.size() <= before.size() + after.size() || name.compare(0, before.size(), before) != 0 ||
            name.compare(name.size() - after.size(), after.size(), after) != 0)
            return false;
        const std::string middle = name.substr(before.size(), name.size() - before.size() - after.size());
        if (middle.find_first_not_of("0123456789") != std::string::npos || middle.size() < digits || middle.size() > 15)
            return false;
        number = std::stol(middle);
        return true;
    }
};

// By how many frames each is after the one before. Numbers of which even the nearest would be more than a second apart
// don't count frames, but perhaps microseconds: there the nearest ones are those of neighbours.
std::vector<double> intervalsOf(const std::vector<long>& numbers)
{
    std::vector<double> intervals;
    long step = LONG_MAX;
    for (size_t i = 0; i < numbers.size(); i++)
    {
        const long gap = i > 0 ? numbers[i] - numbers[i - 1] : 0;
        if (gap > 0)
            step = std::min(step, gap);
        intervals.push_back(double(gap));
    }
    const long framesOfSecond = 30, unit = step > framesOfSecond ? step : 1;
    for (double& interval : intervals)
        interval = std::max(std::round(interval / double(unit)), 1.);
    return intervals;
}

std::vector<std::string> imagesOf(const NumberPattern& pattern, const std::string& folder,
                                  std::vector<double>& intervals)
{
    std::set<std::pair<long, std::string>> found; // f_1 and f_01 have the same number
    for (const std::string& path : filesOf(folder.empty() ? "." : folder))
    {
        long number = 0;
        if (pattern.match(fileName(path), number))
            found.insert(std::make_pair(number, folder + fileName(path)));
    }
    std::vector<std::string> images;
    std::vector<long> numbers;
    for (const std::pair<long, std::string>& entry : found)
    {
        images.push_back(entry.second);
        numbers.push_back(entry.first);
    }
    intervals = intervalsOf(numbers);
    return images;
}

// The last numbers of names that differ in nothing else; none if they do.
std::vector<long> numbersOf(const std::vector<std::string>& images)
{
    std::vector<long> numbers;
    const std::string digits = "0123456789", first = images.empty() ? std::string() : fileName(images[0]);
    const size_t end = first.find_last_of(digits, first.rfind('.'));
    if (end == std::string::npos)
        return numbers;
    const size_t begin = first.find_last_not_of(digits, end) + 1;
    const NumberPattern pattern = {first.substr(0, begin), first.substr(end + 1), 1};
    for (const std::string& path : images)
    {
        long number = 0;
        if (!pattern.match(fileName(path), number))
            return std::vector<long>();
        numbers.push_back(number);
    }
    return numbers;
}

std::vector<std::string> linesOf(const std::string& path)
{
    std::ifstream file = openText(path);
    if (!file)
        throw InputError("the list can't be read");
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);)
    {
        if (!line.empty() && line.back() == '\r')
            line.pop_back();
        if (!line.empty())
            lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> expand(const std::string& argument, InputList& list, std::vector<double>& intervals)
{
    if (fs::isDirectory(argument))
    {
        const std::vector<std::string> images = imagesOf(argument, list.warnings);
        intervals = intervalsOf(numbersOf(images));
        return images;
    }
    if (fs::exists(argument))
        return std::vector<std::string>(1, argument);
    if (argument[0] == '@')
    {
        list.lists.push_back(argument.substr(1));
        const std::vector<std::string> images = linesOf(list.lists.back());
        intervals = intervalsOf(numbersOf(images));
        return images;
    }
    NumberPattern pattern;
    const std::string name = fileName(argument);
    if (pattern.parse(name))
        return imagesOf(pattern, argument.substr(0, argument.size() - name.size()), intervals);
    throw InputError("there is no such file");
}

} // namespace

InputList listInputs(const std::vector<std::string>& arguments)
{
    InputList list;
    const auto add = [&list](const std::string& name, double intervals, const std::string& error) {
        list.inputs.push_back(Input{name, int(list.inputs.size()), intervals, error});
    };
    // As a shell makes them of a pattern.
    const bool areFiles = std::all_of(arguments.begin(), arguments.end(), [](const std::string& argument) {
        return fs::exists(argument) && !fs::isDirectory(argument);
    });
    const std::vector<double> ofFiles = areFiles ? intervalsOf(numbersOf(arguments)) : std::vector<double>();
    for (const std::string& argument : arguments)
        try
        {
            std::vector<double> intervals;
            if (!ofFiles.empty())
                intervals.push_back(ofFiles[list.inputs.size()]);
            const std::vector<std::string> files = expand(argument, list, intervals);
            intervals.resize(files.size(), 1);
            if (files.empty())
                throw InputError("there are no images");
            for (size_t i = 0; i < files.size(); i++)
                add(files[i], intervals[i], isPipe(files[i]) ? PIPE : "");
        }
        catch (const InputError& e)
        {
            add(argument, 1, e.what());
        }
    list.single = arguments.size() == 1 && list.inputs.size() == 1 && list.inputs[0].name == arguments[0];
    return list;
}

std::vector<std::string> filesOf(const InputList& inputs)
{
    std::vector<std::string> files = inputs.lists;
    for (const Input& input : inputs.inputs)
        if (input.isFile())
            files.push_back(input.name);
    return files;
}

void keepShard(InputList& inputs, int shard, int count)
{
    std::vector<Input> kept;
    for (size_t i = size_t(shard - 1); i < inputs.inputs.size(); i += size_t(count))
        kept.push_back(inputs.inputs[i]);
    inputs.inputs.swap(kept);
}

} // namespace rsackermann_samples
