//! The filter of system calls: a list of those that no tracer needs, and that reach beyond its own
//! processes.

use std::collections::BTreeMap;
use std::io;

use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, TargetArch, sock_filter,
};

/// The compiled filters, which are made once.
#[derive(Debug)]
pub(super) struct Filters(Result<Vec<BpfProgram>, String>);

/// Calls that are refused with EPERM.
const REFUSED: [i64; 45] = [
    libc::SYS_acct,
    libc::SYS_add_key,
    libc::SYS_bpf,
    libc::SYS_chroot,
    libc::SYS_clock_adjtime,
    libc::SYS_clock_settime,
    libc::SYS_delete_module,
    libc::SYS_fanotify_init,
    libc::SYS_finit_module,
    libc::SYS_fsconfig,
    libc::SYS_fsmount,
    libc::SYS_fsopen,
    libc::SYS_init_module,
    libc::SYS_ioperm,
    libc::SYS_iopl,
    libc::SYS_kcmp,
    libc::SYS_kexec_file_load,
    libc::SYS_kexec_load,
    libc::SYS_keyctl,
    libc::SYS_lookup_dcookie,
    libc::SYS_mount,
    libc::SYS_mount_setattr,
    libc::SYS_move_mount,
    libc::SYS_name_to_handle_at,
    libc::SYS_open_by_handle_at,
    libc::SYS_open_tree,
    libc::SYS_perf_event_open,
    libc::SYS_pidfd_getfd,
    libc::SYS_pivot_root,
    libc::SYS_process_madvise,
    libc::SYS_process_vm_readv,
    libc::SYS_process_vm_writev,
    libc::SYS_ptrace,
    libc::SYS_quotactl,
    libc::SYS_reboot,
    libc::SYS_request_key,
    libc::SYS_setdomainname,
    libc::SYS_sethostname,
    libc::SYS_setns,
    libc::SYS_settimeofday,
    libc::SYS_swapoff,
    libc::SYS_swapon,
    libc::SYS_syslog,
    libc::SYS_umount2,
    libc::SYS_unshare,
];
/// Calls that are answered with ENOSYS, as by an older system. C libraries then use others:
/// `clone` instead of `clone3`, whose flags a filter cannot read.
const UNKNOWN: [i64; 7] = [
    libc::SYS_clone3,
    libc::SYS_io_uring_enter,
    libc::SYS_io_uring_register,
    libc::SYS_io_uring_setup,
    libc::SYS_pidfd_open,
    libc::SYS_pidfd_send_signal,
    libc::SYS_userfaultfd,
];
/// The families of sockets that programs may open. They stay on the machine.
const FAMILIES: [libc::c_int; 2] = [libc::AF_UNIX, libc::AF_NETLINK];
/// The first number of the calls with 32-bit pointers on x86-64, which the lists do not name.
const X32: u32 = 0x4000_0000;

/// Compiles the filters for this machine.
pub(super) fn compile() -> Filters {
    Filters(all().map_err(|why| why.to_string()))
}

fn all() -> Result<Vec<BpfProgram>, seccompiler::BackendError> {
    let arch = TargetArch::try_from(std::env::consts::ARCH)?;
    let errno = |code: libc::c_int| SeccompAction::Errno(code.cast_unsigned());
    let filter = |rules, code| -> Result<BpfProgram, seccompiler::BackendError> {
        SeccompFilter::new(rules, SeccompAction::Allow, errno(code), arch)?.try_into()
    };
    let always = |calls: &[i64]| calls.iter().map(|call| (*call, vec![])).collect();
    let mut refused: BTreeMap<i64, Vec<SeccompRule>> = always(&REFUSED);
    refused.insert(libc::SYS_socket, vec![other_family()?]);
    let new_user = libc::CLONE_NEWUSER.cast_unsigned().into();
    let masked = SeccompCmpOp::MaskedEq(new_user);
    let flag = SeccompCondition::new(0, SeccompCmpArgLen::Qword, masked, new_user)?;
    refused.insert(libc::SYS_clone, vec![SeccompRule::new(vec![flag])?]);
    let mut programs = vec![filter(refused, libc::EPERM)?, filter(always(&UNKNOWN), libc::ENOSYS)?];
    if arch == TargetArch::x86_64 {
        programs.push(without_x32());
    }
    Ok(programs)
}

/// Returns the rule for sockets of families that are not listed.
fn other_family() -> Result<SeccompRule, seccompiler::BackendError> {
    let differs = |family: &libc::c_int| {
        let family = u64::from(family.cast_unsigned());
        SeccompCondition::new(0, SeccompCmpArgLen::Dword, SeccompCmpOp::Ne, family)
    };
    SeccompRule::new(FAMILIES.iter().map(differs).collect::<Result<_, _>>()?)
}

/// Returns the filter that answers ENOSYS to calls with 32-bit pointers: it loads the number of the
/// call, and compares.
fn without_x32() -> BpfProgram {
    let (load, compare, answer) = (0x20, 0x35, 0x06); // LD|W|ABS, JMP|JGE|K, RET|K
    let refuse = 0x0005_0000 | libc::ENOSYS.cast_unsigned(); // SECCOMP_RET_ERRNO
    let allow = 0x7fff_0000; // SECCOMP_RET_ALLOW
    [(load, 0, 0), (compare, 1, X32), (answer, 0, refuse), (answer, 0, allow)]
        .map(|(code, jf, k)| sock_filter { code, jt: 0, jf, k })
        .to_vec()
}

impl Filters {
    /// Installs the filters for this process and all that it starts.
    pub(super) fn apply(&self) -> io::Result<()> {
        let programs = self.0.as_ref().map_err(|why| io::Error::other(why.clone()))?;
        programs
            .iter()
            .try_for_each(|program| seccompiler::apply_filter(program).map_err(io::Error::other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_filters_compile_and_each_call_is_listed_once() {
        assert!(all().is_ok_and(|programs| programs.len() >= 2));
        let mut calls = [&REFUSED[..], &UNKNOWN].concat();
        calls.sort();
        calls.dedup();
        assert_eq!(calls.len(), REFUSED.len() + UNKNOWN.len());
    }
}
