"""Checks the symbols and calls in the object of a student's file: everything outside the lists is refused.

An answer computes numbers. It needs the C++ library, mathematics, memory, text, and the course's own functions. It may
have the sections that compilers write, and no symbol that replaces another program's.
"""

import re

from grading.elf import Object

_SECTIONS = re.compile(
    r"(?:\.rela?)?\.(text|data|bss|rodata|tdata|tbss|gcc_except_table|eh_frame|group|comment|debug_\w+|symtab|strtab"
    r"|shstrtab|symtab_shndx|note\.GNU-stack|note\.gnu\.property|llvm_addrsig|linker-options|init_array)(\..*)?")
_LIBRARY = re.compile(
    r"_Zn[wa]|_Zd[la]"  # operator new and delete
    r"|_ZT[ISVT](?:[a-z]|P\w*|N?St|N?10__cxxabiv1|N9__gnu_cxx)|_ZN?K?(?:V|R)?S[tabsiod]|_ZNK?S|_ZNK?9__gnu_cxx"
    r"|_ZNK?10__cxxabiv1|_ZGTt|__cxa_|__gxx_personality_v0$|_Unwind_Resume$|__stack_chk_fail$|__dso_handle$"
    r"|__dynamic_cast$|_GLOBAL_OFFSET_TABLE_$|__tls_get_addr$|__assert_fail$|__glibcxx_assert_fail$|__errno_location$"
    r"|__signbit|__(?:mul|div|pow|add|sub|float|fix|ext|trunc|popcount|parity|clz|ctz|bswap|udiv|umod|mod|ash|lsh)"
    r"[a-z]*\d?$|__(?:eq|ne|lt|le|gt|ge|cmp|unord|neg)[a-z]f2$|__cpu_(?:model|indicator_init|features2)$"
    r"|__ctype_\w+_loc$|__\w+_chk$|__isoc\d\d_\w+$|__gthrw_|__libc_single_threaded$|__once_proxy$|__aarch64_\w+$"
    r"|__sanitizer_cov_trace_pc$")  # where a test counts operations
_MATHS = ("acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh erf erfc exp exp10 exp2 expm1 fabs fdim "
          "floor fma fmax fmin fmod frexp hypot ilogb isinf isnan finite j0 j1 jn ldexp lgamma llrint llround log "
          "log10 log1p log2 logb lrint lround modf nan nearbyint nextafter nexttoward pow remainder remquo rint round "
          "roundeven cabs carg cexp clog conj cpow cproj csin ccos ctan csinh ccosh ctanh casin cacos catan csqrt "
          "cacosh casinh catanh cimag creal drem gamma lgamma_r significand scalb pow10 scalbln scalbn sin sincos sinh "
          "sqrt tan tanh tgamma trunc y0 y1 yn")
_C = ("abort abs aligned_alloc atexit atof atoi atol atoll bcmp bsearch calloc clock clock_gettime clock_nanosleep "
      "difftime div drand48 exit fclose feof ferror fflush fgets fopen fprintf fputc fputs fread free fscanf fseek "
      "ftell fwrite getc getchar getenv gettimeofday gmtime imaxabs isalnum isalpha isdigit isspace labs ldiv llabs "
      "lldiv localtime malloc memchr memcmp memcpy memmove memset mktime nanosleep perror posix_memalign printf putc "
      "putchar puts qsort quick_exit rand rand_r random realloc rewind scanf setbuf setlocale setvbuf sleep snprintf "
      "sprintf srand srand48 srandom sscanf stderr stdin stdout stpcpy strcat strchr strcmp strcpy strdup strerror "
      "strftime strlen strncat strncmp strncpy strpbrk strrchr strspn strcspn strstr strtod strtof strtok strtol "
      "strtold strtoll strtoul strtoull time tolower toupper ungetc usleep vfprintf vprintf vsnprintf vsprintf wcslen "
      "wmemchr wmemcmp wmemcpy wmemmove wmemset sched_yield raise _Exit _exit asprintf "
      "vasprintf getpid gettid isatty secure_getenv sysconf feclearexcept fegetenv fegetexceptflag fegetround "
      "feholdexcept feraiseexcept fesetenv fesetexceptflag fesetround fetestexcept feupdateenv feenableexcept "
      "fedisableexcept fegetexcept lgammaf_r lgammal_r ctime asctime clock_getres getrusage fgetc fileno clearerr "
      "getline __getdelim setlinebuf at_quick_exit sched_getcpu bzero explicit_bzero memmem mempcpy memrchr "
      "rawmemchr stpncpy strcasecmp strcasestr strchrnul strcoll strncasecmp strndup strnlen strsep swprintf "
      "vswprintf wcscmp wcscpy isupper islower isprint ispunct isxdigit iscntrl isgraph isblank isascii toascii "
      "localtime_r gmtime_r asctime_r ctime_r timespec_get erand48 lrand48 mrand48 strtok_r strxfrm "
      "memccpy strtoimax strtoumax imaxdiv remove rename tmpfile fgetpos fsetpos vscanf vfscanf vsscanf getdelim "
      "mblen mbtowc wctomb mbstowcs wcstombs mbrlen mbrtowc wcrtomb mbsrtowcs wcsrtombs mbsinit btowc wctob "
      "wcscat wcschr wcscoll wcscspn wcsncat wcsncmp wcsncpy wcspbrk wcsrchr wcsspn wcsstr wcstod wcstof wcstok "
      "wcstol wcstold wcstoll wcstoul wcstoull wcsxfrm wcsftime fgetwc fgetws fputwc fputws getwc getwchar putwc "
      "putwchar ungetwc fwide fwprintf wprintf vfwprintf vwprintf fwscanf wscanf swscanf iswalnum iswalpha iswblank "
      "iswcntrl iswdigit iswgraph iswlower iswprint iswpunct iswspace iswupper iswxdigit towlower towupper")
_THREADS = re.compile(r"pthread_(create|join|detach|self|equal|once|key_create|key_delete|getspecific|setspecific"
                      r"|(mutex|cond|rwlock|mutexattr|attr)_\w+)|sem_\w+")
_KNOWN = frozenset(_C.split()) | {name + kind for name in _MATHS.split() for kind in ("", "f", "l")}
# Each has its reason: it starts processes, looks into them, opens the net, loads code, or changes what memory is for.
# A call that is on no list is refused, too, but is no attack.
_REACHING_OUT = frozenset(
    "fork vfork _Fork clone clone3 daemon posix_spawn posix_spawnp system popen execl execle execlp execv execve "
    "execvp execvpe execveat fexecve kill killpg tgkill tkill pthread_kill sigqueue ptrace process_vm_readv "
    "process_vm_writev prctl arch_prctl syscall mprotect pkey_mprotect pkey_set pkey_alloc "
    "dlopen dlmopen dlsym dlvsym dl_iterate_phdr socket socketpair connect accept bind listen send sendto sendmsg "
    "recv recvfrom recvmsg unshare setns read write pread pwrite readv writev close dup dup2 dup3 "
    "_dl_open __libc_dlopen_mode _Unwind_Backtrace _Unwind_ForcedUnwind _Unwind_RaiseException "
    "_Unwind_SetIP _Unwind_SetGR _Unwind_GetIP _Unwind_GetCFA setcontext swapcontext makecontext getcontext "
    "__bss_start _end _edata edata end __data_start _start main __libc_start_main".split())
_HARMLESS_IF_WEAK = ("_ITM_", "__gmon_start__", "__cxa_", "__gthrw_", "pthread_", "__pthread_key_create", "_ZGTt",
                     "_ZNSt", "_ZSt", "__tls_init", "_ZTH", "_ZTW")
_OF_TESTS = re.compile(r"NK?(?:5spook)?7testing|N?5spook6remote|6googletest")
_COUNTER = "__sanitizer_cov_trace_pc"
REMOVED = "system"  # as in system("pause"), which keeps a window open elsewhere
# What is linked in their place. The library calls syscall() where threads wait for each other.
REPLACED = {REMOVED: "spook_no_system", "syscall": "spook_only_futex"}


_NAME = re.compile(r"[\w.$]+")  # to the linker an @ begins a version
_UNSHOWN = re.compile(r"[^\w.$@ -]", re.ASCII)
_LONGEST = 80  # characters that are shown of a name


def shown(name: str) -> str:
    """Returns a section's or symbol's name for a report: it may have any bytes, and megabytes of them."""
    return _UNSHOWN.sub("?", name[:_LONGEST]) + ("..." if len(name) > _LONGEST else "")


def tampering(found: Object) -> str:
    """Describes signs of tampering that no answer has by accident; empty if there are none."""
    for section in found.sections:
        if not _SECTIONS.fullmatch(section) or ".init_array." in section:
            early = re.match(r"(?:\.rela?)?\.(init|fini|preinit_array|init_array|fini_array|ctors|dtors)\b", section)
            return (f"has code that runs before main or after it, in {shown(section)}" if early
                    else f"has a section {shown(section)}, which no compiler makes of an answer")
    for symbol in found.symbols:
        if symbol.kind not in ("SECTION", "FILE") and not _NAME.fullmatch(symbol.name):
            return f"has the symbol '{shown(symbol.name)}', and no compiler names one so"
        if symbol.defined and symbol.name == _COUNTER:
            return "counts its operations itself"
        if _OF_TESTS.search(symbol.name):
            return "names GoogleTest's or the tests' own functions"
        if symbol.kind == "IFUNC":
            return "has a function that the loader resolves"
        if symbol.binding not in ("LOCAL", "GLOBAL", "WEAK") or symbol.section == "COM":
            return f"defines {shown(symbol.name)} in place of another program's"
    for symbol in found.symbols:
        if not symbol.defined and symbol.binding != "LOCAL":
            weak = symbol.binding == "WEAK"
            if symbol.name in _REACHING_OUT and (weak or symbol.name not in REPLACED):
                return f"calls {symbol.name}()"
            if weak and not symbol.name.startswith(_HARMLESS_IF_WEAK):
                return f"calls {shown(symbol.name)}() if there is one"
    return ""


def not_allowed(found: Object, course: frozenset[str]) -> str:
    """Returns the name of a called function that is on no list; empty if there is none.

    `course`: the symbols of the exercises that it may call.
    """
    for symbol in found.symbols:
        if symbol.defined or symbol.binding == "LOCAL" or symbol.name in _KNOWN or symbol.name in REPLACED:
            continue
        if _LIBRARY.match(symbol.name) or _THREADS.fullmatch(symbol.name) or symbol.name.startswith(_HARMLESS_IF_WEAK):
            continue
        if symbol.name not in course:
            return symbol.name
    return ""
