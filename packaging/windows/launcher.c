/* The two programs that start BobDesk on Windows: one for the window, one for the console (-DCONSOLE).
 *
 * They load Python's DLL from the folder "runtime" and run the module "launch" in it with their own arguments.
 * RUNTIME is the way from the program's folder to it, PYDLL the DLL's name, PRODUCT what a person calls the program.
 */
#define _WIN32_WINNT 0x0A00
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#include <shellapi.h>
#include <stdio.h>
#include <stdlib.h>
#include <wchar.h>

#define LONGEST_PATH 32768
#define FAILED_STATUS 1

typedef int (*python_main)(int, wchar_t **);

static int failed(const wchar_t *sentence)
{
#ifdef CONSOLE
    fwprintf(stderr, L"%ls\n", sentence);
#else
    MessageBoxW(NULL, sentence, PRODUCT, MB_OK | MB_ICONERROR);
#endif
    return FAILED_STATUS;
}

static int run(void)
{
    static wchar_t program[LONGEST_PATH], runtime[LONGEST_PATH], library[LONGEST_PATH];
    static wchar_t *first[] = {program, L"-I", L"-X", L"utf8", L"-m", L"launch"};
    const int fixed = sizeof first / sizeof *first;
    const wchar_t *damaged = L"A part of " PRODUCT L" is missing (" PYDLL L"). Install " PRODUCT L" again.";

    int given = 0;
    wchar_t **words = CommandLineToArgvW(GetCommandLineW(), &given);
    DWORD length = GetModuleFileNameW(NULL, program, LONGEST_PATH);
    if (words == NULL || length == 0 || length + 64 > LONGEST_PATH)
        return failed(L"The command line cannot be read. Move " PRODUCT L" to a folder with a shorter path.");

    wcscpy(runtime, program);
    wcscpy(wcsrchr(runtime, L'\\') + 1, RUNTIME);
    if (GetFullPathNameW(runtime, LONGEST_PATH - 32, library, NULL) == 0)
        return failed(damaged);
    wcscpy(runtime, library);

    /* Python's extension modules find the C++ runtime there; the current folder is no place for libraries. */
    AddDllDirectory(runtime);
    SetDllDirectoryW(L"");
    wcscat(library, L"\\" PYDLL);
    HMODULE python = LoadLibraryExW(library, NULL, LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR | LOAD_LIBRARY_SEARCH_DEFAULT_DIRS);
    if (python == NULL)
        return failed(damaged);
    python_main start = (python_main)(void *)GetProcAddress(python, "Py_Main");
    wchar_t **all = calloc((size_t)(fixed + given), sizeof *all);
    if (start == NULL || all == NULL)
        return failed(damaged);

    int count = 0;
    for (; count < fixed; count++)
        all[count] = first[count];
    for (int at = 1; at < given; at++)
        all[count++] = words[at];
    return start(count, all);
}

#ifdef CONSOLE
int wmain(void) { return run(); }
#else
int WINAPI wWinMain(HINSTANCE here, HINSTANCE before, PWSTR words, int show)
{
    (void)here, (void)before, (void)words, (void)show;
    return run();
}
#endif
