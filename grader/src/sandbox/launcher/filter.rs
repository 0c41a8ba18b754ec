//! The filter of system calls.
//!
//! Calls that reach beyond a program's own processes are refused. On x86-64, all others that are
//! not in the list of `allowed.rs` are answered as by a system that does not know them; elsewhere,
//! only a few are.

use std::collections::BTreeMap;
use std::io;

use super::allowed::ALLOWED;
use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, TargetArch,
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
/// Calls that are answered with ENOSYS, as by an older system, where there is no list of those that
/// are allowed. C libraries then use others: `clone` instead of `clone3`, whose flags a filter
/// cannot read.
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
/// The rules of a filter, by call. No rule means that the arguments do not matter.
type Rules = BTreeMap<i64, Vec<SeccompRule>>;

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
    let always = |calls: &[i64]| -> Rules { calls.iter().map(|call| (*call, vec![])).collect() };
    let mut refused: Rules = always(&REFUSED);
    refused.insert(libc::SYS_socket, vec![other_family()?]);
    let new_user = libc::CLONE_NEWUSER.cast_unsigned().into();
    let masked = SeccompCmpOp::MaskedEq(new_user);
    let flag = SeccompCondition::new(0, SeccompCmpArgLen::Qword, masked, new_user)?;
    refused.insert(libc::SYS_clone, vec![SeccompRule::new(vec![flag])?]);
    let unknown = match arch {
        // Calls with 32-bit pointers have numbers of their own, which are not in the list.
        TargetArch::x86_64 => {
            let refuse = errno(libc::ENOSYS);
            SeccompFilter::new(always(ALLOWED), refuse, SeccompAction::Allow, arch)?.try_into()?
        }
        _ => filter(always(&UNKNOWN), libc::ENOSYS)?,
    };
    // The filter that is installed last gives the answer where both refuse.
    Ok(vec![unknown, filter(refused, libc::EPERM)?])
}

/// Returns the rule for sockets of families that are not listed.
fn other_family() -> Result<SeccompRule, seccompiler::BackendError> {
    let differs = |family: &libc::c_int| {
        let family = u64::from(family.cast_unsigned());
        SeccompCondition::new(0, SeccompCmpArgLen::Dword, SeccompCmpOp::Ne, family)
    };
    SeccompRule::new(FAMILIES.iter().map(differs).collect::<Result<_, _>>()?)
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
        assert!(all().is_ok_and(|programs| programs.len() == 2));
        let mut calls = [&REFUSED[..], &UNKNOWN, ALLOWED].concat();
        calls.sort();
        calls.dedup();
        assert_eq!(calls.len(), REFUSED.len() + UNKNOWN.len() + ALLOWED.len());
    }
}
