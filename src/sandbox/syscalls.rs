//! seccomp: the system calls of a warm worker.
//!
//! Three filters, of which the kernel takes the strictest answer. The list of what is allowed is closed: a call that is
//! not on it fails with "not permitted", so that a driver that merely asks goes another way. Once the preflight has
//! asked, the calls by which code breaks out end the process instead (SIGSYS).

use crate::render::AdapterKind;
use nix::errno::Errno;
use nix::libc;
use seccompiler::{
    BackendError, BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, TargetArch,
};
use std::collections::BTreeMap;

type SyscallRules = BTreeMap<i64, Vec<SeccompRule>>;

/// What grading, memory management, threads, and Rust's and C's ways to abort call.
const ALLOWED: [i64; 53] = [
    // Memory: the driver compiles into fresh pages, and newer ones keep buffers in anonymous files.
    libc::SYS_brk,
    libc::SYS_fallocate,
    libc::SYS_ftruncate,
    libc::SYS_madvise,
    libc::SYS_membarrier,
    libc::SYS_memfd_create,
    libc::SYS_mincore,
    libc::SYS_mmap,
    libc::SYS_mprotect,
    libc::SYS_mremap,
    libc::SYS_munmap,
    // Threads.
    libc::SYS_exit,
    libc::SYS_futex,
    libc::SYS_getcpu,
    libc::SYS_rseq,
    libc::SYS_sched_getaffinity,
    libc::SYS_sched_yield,
    libc::SYS_set_robust_list,
    // The pipes, which are open.
    libc::SYS_close,
    libc::SYS_eventfd2,
    libc::SYS_fstat,
    libc::SYS_lseek,
    libc::SYS_ppoll,
    libc::SYS_pread64,
    libc::SYS_read,
    libc::SYS_readv,
    libc::SYS_write,
    libc::SYS_writev,
    // Time, chance, and questions about oneself.
    libc::SYS_clock_getres,
    libc::SYS_clock_gettime,
    libc::SYS_clock_nanosleep,
    libc::SYS_getegid,
    libc::SYS_geteuid,
    libc::SYS_getgid,
    libc::SYS_getpid,
    libc::SYS_getppid,
    libc::SYS_getrandom,
    libc::SYS_getrusage,
    libc::SYS_gettid,
    libc::SYS_gettimeofday,
    libc::SYS_getuid,
    libc::SYS_nanosleep,
    libc::SYS_sysinfo,
    libc::SYS_times,
    libc::SYS_uname,
    // Signals to oneself; the end.
    libc::SYS_exit_group,
    libc::SYS_restart_syscall,
    libc::SYS_rt_sigaction,
    libc::SYS_rt_sigprocmask,
    libc::SYS_rt_sigreturn,
    libc::SYS_sigaltstack,
    // Further filters can only narrow what is allowed.
    libc::SYS_seccomp,
    libc::SYS_set_tid_address,
];

/// What no grading does, and code that breaks out does.
const DEADLY: [i64; 36] = [
    libc::SYS_accept,
    libc::SYS_accept4,
    libc::SYS_add_key,
    libc::SYS_bind,
    libc::SYS_bpf,
    libc::SYS_chroot,
    libc::SYS_connect,
    libc::SYS_execve,
    libc::SYS_execveat,
    libc::SYS_finit_module,
    libc::SYS_init_module,
    libc::SYS_io_uring_setup,
    libc::SYS_kexec_load,
    libc::SYS_keyctl,
    libc::SYS_kill,
    libc::SYS_listen,
    libc::SYS_mount,
    libc::SYS_open_by_handle_at,
    libc::SYS_perf_event_open,
    libc::SYS_pidfd_open,
    libc::SYS_pidfd_send_signal,
    libc::SYS_pivot_root,
    libc::SYS_process_vm_readv,
    libc::SYS_process_vm_writev,
    libc::SYS_ptrace,
    libc::SYS_reboot,
    libc::SYS_rt_sigqueueinfo,
    libc::SYS_setgid,
    libc::SYS_setns,
    libc::SYS_setuid,
    libc::SYS_socket,
    libc::SYS_socketpair,
    libc::SYS_tkill,
    libc::SYS_umount2,
    libc::SYS_unshare,
    libc::SYS_userfaultfd,
];

/// Lets all threads of this process make only the calls of a grading; others fail.
pub(super) fn restrict(adapter: AdapterKind) -> Result<String, String> {
    let not_permitted = SeccompAction::Errno(Errno::EPERM as u32);
    install(allowed(adapter).map_err(text)?, not_permitted, SeccompAction::Allow)?;
    // The kernel cannot look into clone3's arguments. "No such call" makes C fall back to clone, whose flags it can see.
    let clone3 = SyscallRules::from([(libc::SYS_clone3, Vec::new())]);
    install(clone3, SeccompAction::Allow, SeccompAction::Errno(Errno::ENOSYS as u32))?;
    Ok("seccomp".into())
}

/// Ends the process where it tries to break out.
pub(super) fn make_deadly() -> Result<(), String> {
    let mut rules: SyscallRules = DEADLY.iter().map(|&call| (call, Vec::new())).collect();
    #[cfg(target_arch = "x86_64")]
    rules.extend([libc::SYS_fork, libc::SYS_vfork].map(|call| (call, Vec::new())));
    let process = when(0, SeccompCmpOp::MaskedEq(libc::CLONE_THREAD as u64), 0);
    rules.insert(libc::SYS_clone, vec![process.map_err(text)?]);
    install(rules, SeccompAction::Allow, SeccompAction::KillProcess)
}

fn allowed(adapter: AdapterKind) -> Result<SyscallRules, BackendError> {
    let mut rules: SyscallRules = ALLOWED.iter().map(|&call| (call, Vec::new())).collect();
    #[cfg(target_arch = "x86_64")]
    rules.extend([libc::SYS_poll, libc::SYS_time].map(|call| (call, Vec::new())));
    if adapter == AdapterKind::Gpu {
        rules.insert(libc::SYS_ioctl, Vec::new());
    }
    let equals = |argument, value: u64| when(argument, SeccompCmpOp::Eq, value);
    // A thread, never a process.
    let thread = libc::CLONE_THREAD as u64;
    rules.insert(libc::SYS_clone, vec![when(0, SeccompCmpOp::MaskedEq(thread), thread)?]);
    // Signals to this process alone: that is how C aborts.
    rules.insert(libc::SYS_tgkill, vec![equals(0, u64::from(std::process::id()))?]);
    // Limits of this process alone; without rights they only go down, or up to the hard limit.
    rules.insert(libc::SYS_prlimit64, vec![equals(0, 0)?]);
    let harmless = [libc::PR_SET_NAME, libc::PR_SET_NO_NEW_PRIVS, libc::PR_SET_VMA];
    let harmless: Result<_, _> = harmless.iter().map(|&option| equals(0, option as u64)).collect();
    rules.insert(libc::SYS_prctl, harmless?);
    let questions = [libc::F_GETFD, libc::F_SETFD, libc::F_GETFL];
    let questions: Result<_, _> = questions.iter().map(|&command| equals(1, command as u64)).collect();
    rules.insert(libc::SYS_fcntl, questions?);
    Ok(rules)
}

/// A rule on the low 32 bits of one argument, which is all that these calls look at.
fn when(argument: u8, operator: SeccompCmpOp, value: u64) -> Result<SeccompRule, BackendError> {
    SeccompRule::new(vec![SeccompCondition::new(argument, SeccompCmpArgLen::Dword, operator, value)?])
}

fn install(rules: SyscallRules, otherwise: SeccompAction, listed: SeccompAction) -> Result<(), String> {
    let machine = TargetArch::try_from(std::env::consts::ARCH).map_err(text)?;
    let filter = SeccompFilter::new(rules, otherwise, listed, machine).map_err(text)?;
    let program = BpfProgram::try_from(filter).map_err(text)?;
    seccompiler::apply_filter_all_threads(&program).map_err(|error| error.to_string())
}

fn text(error: BackendError) -> String {
    error.to_string()
}
