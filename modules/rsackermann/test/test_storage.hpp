// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_TEST_STORAGE_HPP
#define OPENCV_RSACKERMANN_TEST_STORAGE_HPP

#include "test_common.hpp"

namespace opencv_test {

template <class Struct>
std::string written(const Struct& value, const char* format)
{
    FileStorage out(format, FileStorage::WRITE | FileStorage::MEMORY);
    out << "value"
        << "{";
    value.write(out);
    out << "}";
    return out.releaseAndGetString();
}

template <class Struct>
void readFrom(const std::string& text, Struct& value)
{
    value.read(FileStorage(text, FileStorage::READ | FileStorage::MEMORY)["value"]);
}

//! @param example value all of whose fields differ from those of the default.
//! @param key key of one field, whose value in the file is 0.
template <class Struct, class Field>
void checkStorage(const Struct& example, const char* key, Field Struct::*field)
{
    const char* const formats[] = {".yml", ".xml", ".json"};
    for (int i = 0; i < 3; i++)
    {
        Struct restored;
        readFrom(written(example, formats[i]), restored);
        expectSame(example, restored);
    }

    Struct partly = example, expected = example;
    readFrom(format("%%YAML:1.0\n---\nvalue:\n   %s: 0\n", key), partly);
    expected.*field = 0;
    expectSame(expected, partly);
    partly.read(FileNode());
    expectSame(expected, partly);
}

template <class Algorithm>
void checkSaveAndLoad(const typename Algorithm::Params& example, const char* name)
{
    const Ptr<Algorithm> saved = Algorithm::create(exampleCamera(), example);
    EXPECT_EQ(name, saved->getDefaultName());
    const std::string file = cv::tempfile(".yml");
    saved->save(file);
    for (int byName = 0; byName < 2; byName++)
    {
        const Ptr<Algorithm> loaded = Algorithm::load(file, byName ? name : "");
        expectSame(exampleCamera(), loaded->getCamera());
        expectSame(example, loaded->getParams());
    }
    EXPECT_THROW(Algorithm::load(file, "another_name"), cv::Exception);
    remove(file.c_str());
    EXPECT_THROW(Algorithm::load(file), cv::Exception);

    // Into an algorithm that is there.
    FileStorage out(".yml", FileStorage::WRITE | FileStorage::MEMORY);
    saved->write(out);
    const FileStorage in(out.releaseAndGetString(), FileStorage::READ | FileStorage::MEMORY);
    const Ptr<Algorithm> other = Algorithm::create(RollingShutterCamera::fromFocal(Size(64, 48)));
    other->read(in.root());
    expectSame(exampleCamera(), other->getCamera());
    expectSame(example, other->getParams());
}

//! The message of load() from a file with this content; empty: it succeeds.
template <class Algorithm>
std::string complaintOfLoad(const std::string& file, const std::string& content)
{
    std::ofstream(file, std::ios::binary) << content;
    try
    {
        Algorithm::load(file);
        return std::string();
    }
    catch (const cv::Exception& e)
    {
        return e.err.empty() ? "?" : e.err;
    }
}

//! A file that ends at some byte, or at any of the last ones, is refused, and one that ends before a key is refused by
//! its name.
template <class Algorithm>
void checkCutFiles(const typename Algorithm::Params& example)
{
    for (const char* format : {".yml", ".xml", ".json"})
    {
        const std::string file = cv::tempfile(format);
        Algorithm::create(exampleCamera(), example)->save(file);
        std::ifstream stream(file, std::ios::binary);
        const std::string whole((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
        const std::string content = whole.substr(0, whole.find_last_not_of(" \n") + 1);
        EXPECT_EQ("", complaintOfLoad<Algorithm>(file, content)) << format;
        for (size_t length = 0; length < content.size(); length += length + 40 < content.size() ? 29 : 1)
        {
            if (length > 0 && content[length - 1] == '=') // OpenCV's parser of XML would read beyond the end
                continue;
            ASSERT_NE("", complaintOfLoad<Algorithm>(file, content.substr(0, length))) << format << " " << length;
        }
        for (const char* key : {"focal_sigma", "tolerance", "estimator", "suspension_time", "algorithm"})
        {
            const size_t at = content.find(std::string(" ") + key + ':');
            if (at != std::string::npos) // in YAML, if the algorithm has it
            {
                const std::string complaint =
                    complaintOfLoad<Algorithm>(file, content.substr(0, content.rfind('\n', at) + 1));
                EXPECT_NE(std::string::npos, complaint.find(key)) << key << ": " << complaint;
            }
        }
        remove(file.c_str());
    }
}

//! @param text file with something that is out of range, and with other values that aren't.
template <class Algorithm>
void checkAllOrNothing(const typename Algorithm::Params& example, const char* text)
{
    const Ptr<Algorithm> algorithm = Algorithm::create(exampleCamera(), example);
    const FileStorage in(std::string("%YAML:1.0\n---\n") + text, FileStorage::READ | FileStorage::MEMORY);
    EXPECT_THROW(algorithm->read(in.root()), cv::Exception);
    expectSame(exampleCamera(), algorithm->getCamera());
    expectSame(example, algorithm->getParams());
}

} // namespace opencv_test

#endif // OPENCV_RSACKERMANN_TEST_STORAGE_HPP
